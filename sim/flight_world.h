// Bullet's world: solid ground and buildings, and the quadcopters that fly there.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <memory>
#include <span>
#include <vector>

#include "sim/quadcopter.h"
#include "world/scenario.h"

namespace throng::sim {

/// A craft hit the ground, a building or another craft. One per approach: staying in touch, or
/// touching again within half a second, is the same one.
struct Impact {
  std::size_t craft;
  double speed_mps;  ///< just before
};

/// Same calls give the same bits. Not to be shared between threads.
class FlightWorld {
 public:
  FlightWorld(const std::vector<world::Building>& buildings, double dt_s);
  ~FlightWorld();
  FlightWorld(FlightWorld&&) noexcept;
  FlightWorld& operator=(FlightWorld&&) noexcept;

  /// Adds a craft at rest; returns its index.
  std::size_t add(const Airframe& airframe, const Eigen::Vector3d& position, double yaw_rad);

  /// Rotor speeds (rad/s) that the craft's motors go for from now on.
  void command(std::size_t craft, const PerRotor& rotor_speeds);
  /// Wind at the craft (m/s); still air until told otherwise.
  void set_air_velocity(std::size_t craft, const Eigen::Vector3d& velocity);

  /// Advances by dt_s().
  void step();

  double dt_s() const;
  std::size_t size() const;
  FlightState state(std::size_t craft) const;
  Eigen::Quaterniond orientation(std::size_t craft) const;
  /// What was hit in the last step.
  std::span<const Impact> impacts() const;

 private:
  struct Bodies;
  std::unique_ptr<Bodies> bodies_;
};

}  // namespace throng::sim
