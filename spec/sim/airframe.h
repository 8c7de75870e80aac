// Parameters of a quadcopter: mass, geometry, rotors, autopilot, sensors. SI units throughout.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "spec/sim/autopilot.h"
#include "spec/sim/electric_motor.h"
#include "spec/sim/sensor_noise.h"

namespace throng::sim {

inline constexpr double kGravity = 9.81;  ///< m/s²

/// A rotor's axis in the body frame (x ahead, y left) and its sense of rotation.
struct Rotor {
  Eigen::Vector2d at_m = Eigen::Vector2d::Zero();
  double sense = 1;  ///< +1: counter-clockwise from above, -1: clockwise
};

/// Four rotors in an X, on arms of this length: front left, rear left, rear right, front right.
std::array<Rotor, 4> rotors_in_x(double arm_m);

/// A quadcopter with four equal rotors whose axes point up.
struct Airframe {
  std::string name;
  double mass_kg = 0;
  double arm_m = 0;     ///< from the center to the farthest rotor's axis
  double height_m = 0;  ///< height of the body, for collisions
  double propeller_radius_m = 0;
  std::array<Rotor, 4> rotors;
  Eigen::Vector3d inertia = Eigen::Vector3d::Zero();  ///< kg m², about x (ahead), y (left), z (up)
  double thrust_n_s2 = 0;          ///< thrust of a rotor over the square of its speed, N s²
  double torque_per_thrust_m = 0;  ///< reaction torque of a rotor over its thrust
  double max_rotor_rad_s = 0;
  double motor_up_s = 0;    ///< time constant of acceleration; 0: instantaneous
  double motor_down_s = 0;  ///< time constant of deceleration; 0: instantaneous
  /// Equation of the motors; without it, they are first-order lags.
  std::optional<ElectricMotor> electric_motor;
  double rotor_drag = 0;  ///< drag of a rotor's motion across its axis, N / (rad/s) / (m/s)
  Eigen::Vector2d body_drag = Eigen::Vector2d::Zero();  ///< across and along z, N / (m/s)²
  Eigen::Vector2d turn_drag =
      Eigen::Vector2d::Zero();  ///< about x and y, and about z, N m / (rad/s)²
  /// Ideal over electric power, from the blades to the motor controllers.
  double rotor_efficiency = 0.5;
  double avionics_w = 0;  ///< electric power of everything except the rotors
  double battery_wh = 0;  ///< energy of a full battery; 0: unknown
  /// Impact speeds on a rigid wall above which the propellers that touch it break, and above which
  /// the frame breaks, after which no rotor produces thrust.
  double propeller_limit_mps = 2;
  double structure_limit_mps = 6;
  Autopilot autopilot;
  SensorNoise sensors;

  double weight_n() const { return mass_kg * kGravity; }
  double max_thrust_n() const {
    return std::min(4 * thrust_n_s2 * max_rotor_rad_s * max_rotor_rad_s, autopilot.max_thrust_n);
  }
  /// Radius of the vertical cylinder that encloses the vehicle.
  double radius_m() const { return arm_m + propeller_radius_m; }
  /// Horizontal airspeed that a tilt 5 degrees below the autopilot's limit sustains.
  double top_speed_mps() const;
};

/// The rows thrust (N) and torques about x, y and z (N m), per thrust (N) of each rotor, a column.
Eigen::Matrix4d rotor_mixing(const Airframe& airframe);

/// Parses airframes: an object with one entry per name and the fields of airframes.json. Throws
/// InputError naming `source`, also for a vehicle without enough thrust to hover and steer.
std::vector<Airframe> parse_airframes(std::string_view json, const std::string& source);

/// Reads one airframe: an object with the fields of airframes.json, of which "source" and "camera"
/// are optional and not part of the value: jobs read the camera (spec/job/drone_fields.cpp). Adds
/// to `problems`, with JSON pointers that begin with `pointer`.
Airframe read_airframe(const std::string& name, const nlohmann::json& value,
                       const std::string& pointer, std::vector<Problem>& problems);

/// The inverse of read_airframe().
nlohmann::json to_json(const Airframe& airframe);

/// The airframes shipped with the program (spec/sim/airframes.json, which names their sources).
std::vector<Airframe> shipped_airframes();

/// The shipped airframe of this name; nothing if there is none.
std::optional<Airframe> find_airframe(const std::string& name);

}  // namespace throng::sim
