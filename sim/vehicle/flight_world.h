// The rigid-body world in Bullet: ground, buildings, people and quadcopters.
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

/// Size of people in collisions: upright capsules whose motion is prescribed (kinematic bodies).
inline constexpr double kPersonRadiusM = 0.25;
inline constexpr double kPersonHeightM = 1.7;

/// A person near a vehicle, at the start of the next step.
struct NearPerson {
  int agent = 0;
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< m
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  ///< m/s
};

/// Deterministic: equal calls give equal bits. Not thread-safe.
class FlightWorld {
 public:
  FlightWorld(const std::vector<world::Building>& buildings, double dt_s);
  ~FlightWorld();
  FlightWorld(FlightWorld&&) noexcept;
  FlightWorld& operator=(FlightWorld&&) noexcept;

  /// Adds a vehicle at rest; returns its index.
  std::size_t add(const Airframe& airframe, const Eigen::Vector3d& position, double yaw_rad);

  /// Sets the commanded rotor speeds (rad/s).
  void command(std::size_t vehicle, const PerRotor& rotor_speeds);
  /// Sets the wind at the vehicle (m/s, world); initially zero.
  void set_air_velocity(std::size_t vehicle, const Eigen::Vector3d& velocity);
  /// Sets the downwash of other vehicles on each of the vehicle's rotors (m/s); initially zero.
  void set_downwash(std::size_t vehicle, const PerRotor& downwash_mps);
  /// Breaks a rotor, which then produces no thrust.
  void break_rotor(std::size_t vehicle, std::size_t rotor);
  /// Sets the people that vehicles can touch, who then move at their velocities. People who were in
  /// the previous list continue from the given state.
  void set_people(std::span<const NearPerson> people);

  /// Advances by dt_s().
  void step();

  double dt_s() const;
  std::size_t size() const;
  FlightState state(std::size_t vehicle) const;
  Eigen::Quaterniond orientation(std::size_t vehicle) const;
  /// All forces except gravity over mass in the last step, including contacts, as an ideal
  /// accelerometer measures: m/s², body frame.
  Eigen::Vector3d specific_force(std::size_t vehicle) const;
  /// Total thrust of the rotors in the last step.
  double thrust_n(std::size_t vehicle) const;
  const Airframe& airframe(std::size_t vehicle) const;
  /// Collisions whose impulse was completed in the last step (ContactLog::impacts()).
  std::span<const Impact> impacts() const;
  /// Collisions whose impulse is incomplete (ContactLog::unfinished()).
  std::vector<Impact> unfinished_impacts() const;

 private:
  struct Bodies;
  std::unique_ptr<Bodies> bodies_;
};

}  // namespace throng::sim
