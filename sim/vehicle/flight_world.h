// Bullet's world: solid ground and buildings, people near the ground, and the quadcopters that fly
// there.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <memory>
#include <span>
#include <vector>

#include "sim/vehicle/contact_log.h"
#include "sim/vehicle/quadcopter.h"
#include "world/scenario.h"

namespace throng::sim {

/// People as vehicles meet them: upright capsules that move as they please and cannot be pushed.
inline constexpr double kPersonRadiusM = 0.25;
inline constexpr double kPersonHeightM = 1.7;
/// Restitution of every contact: speed apart after it / speed of approach before it.
inline constexpr double kRestitution = 0.4;

/// Somebody near a vehicle, where the next step begins.
struct NearPerson {
  int agent = 0;
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< m
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  ///< m/s
};

/// Same calls give the same bits. Not to be shared between threads.
class FlightWorld {
 public:
  FlightWorld(const std::vector<world::Building>& buildings, double dt_s);
  ~FlightWorld();
  FlightWorld(FlightWorld&&) noexcept;
  FlightWorld& operator=(FlightWorld&&) noexcept;

  /// Adds a vehicle at rest; returns its index.
  std::size_t add(const Airframe& airframe, const Eigen::Vector3d& position, double yaw_rad);

  /// Rotor speeds (rad/s) that the vehicle's motors go for from now on.
  void command(std::size_t vehicle, const PerRotor& rotor_speeds);
  /// Wind at the vehicle (m/s); still air until set.
  void set_air_velocity(std::size_t vehicle, const Eigen::Vector3d& velocity);
  /// Air that others blow down on each of the vehicle's rotors (m/s); none until set.
  void set_downwash(std::size_t vehicle, const PerRotor& downwash_mps);
  /// The rotor gives no thrust any more.
  void break_rotor(std::size_t vehicle, std::size_t rotor);
  /// The people that vehicles can touch from now on, moving on at their velocities. One that stays
  /// in the list continues from the given state.
  void set_people(std::span<const NearPerson> people);

  /// Advances by dt_s().
  void step();

  double dt_s() const;
  std::size_t size() const;
  FlightState state(std::size_t vehicle) const;
  Eigen::Quaterniond orientation(std::size_t vehicle) const;
  /// All forces but gravity over mass in the last step, contacts included: what an ideal
  /// accelerometer reads. m/s², body.
  Eigen::Vector3d specific_force(std::size_t vehicle) const;
  /// Thrust of all rotors in the last step.
  double thrust_n(std::size_t vehicle) const;
  const Airframe& airframe(std::size_t vehicle) const;
  /// Collisions whose impulse became known in the last step.
  std::span<const Impact> impacts() const;
  /// Collisions whose impulse is still being counted.
  std::vector<Impact> unfinished_impacts() const;

 private:
  struct Bodies;
  std::unique_ptr<Bodies> bodies_;
};

}  // namespace throng::sim
