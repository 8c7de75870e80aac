// Damage of a quadcopter by a collision.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>

#include "sim/vehicle/contact_log.h"
#include "spec/sim/airframe.h"

namespace throng::sim {

/// A contact point of a vehicle and the impulse there, in the vehicle's body frame.
struct Contact {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();    ///< m, from the center
  Eigen::Vector3d push_ns = Eigen::Vector3d::Zero();  ///< on the vehicle
};

/// The rotor whose propeller a contact hits: the nearest one, or none if the push comes from below,
/// where the landing gear is.
std::optional<std::size_t> propeller_hit(const Contact& contact, const Airframe& airframe);

/// Speed (m/s) of an impact on a rigid wall with the same impulse: J / (m (1 + restitution)).
double wall_speed_mps(double impulse_ns, const Airframe& airframe);

/// The damage by one impact.
struct Damage {
  bool structure = false;           ///< the frame is broken, so that no rotor produces thrust
  std::array<bool, 4> propeller{};  ///< broken by this impact
  bool any_propeller() const;
};

/// Damage by an impact, whose wall_speed_mps() is compared with the airframe's limits. The
/// propellers with at least a fifth of the impulse break.
Damage impact_damage(const Impact& impact, const Airframe& airframe);

}  // namespace throng::sim
