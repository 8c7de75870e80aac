// Damage to a quadcopter by a collision.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>

#include "sim/vehicle/contact_log.h"
#include "spec/sim/airframe.h"

namespace throng::sim {

/// One point at which a vehicle is pushed, both in its body frame.
struct Contact {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();    ///< m, from the middle
  Eigen::Vector3d push_ns = Eigen::Vector3d::Zero();  ///< on the vehicle
};

/// The rotor whose propeller a contact goes through: the nearest one, unless the vehicle is pushed
/// from below, where its landing gear is.
std::optional<std::size_t> propeller_hit(const Contact& contact);

/// Speed (m/s) of the impact on a rigid wall that has the same impulse: J / (m (1 + restitution)).
double wall_speed_mps(double impulse_ns, const Airframe& airframe);

struct Damage {
  bool structure = false;           ///< the frame is broken: no rotor gives thrust any more
  std::array<bool, 4> propeller{};  ///< broken by this impact
  bool any_propeller() const;
};

/// Damage by an impact: its speed against a wall is compared with the airframe's limits. Of the
/// propellers those break through which at least a fifth of the impulse came.
Damage impact_damage(const Impact& impact, const Airframe& airframe);

}  // namespace throng::sim
