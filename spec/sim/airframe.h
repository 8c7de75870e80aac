// Parameters of a quadcopter: mass, geometry, rotors. SI units throughout.
#pragma once

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace throng::sim {

inline constexpr double kGravity = 9.81;  ///< m/s²

/// A quadcopter with four equal rotors in an X.
struct Airframe {
  std::string name;
  double mass_kg = 0;
  double arm_m = 0;     ///< from the center to a rotor's axis
  double height_m = 0;  ///< height of the body, for collisions
  double propeller_radius_m = 0;
  Eigen::Vector3d inertia = Eigen::Vector3d::Zero();  ///< kg m², about x (ahead), y (left), z (up)
  double thrust_n_s2 = 0;          ///< thrust of a rotor over the square of its speed, N s²
  double torque_per_thrust_m = 0;  ///< reaction torque of a rotor over its thrust
  double max_rotor_rad_s = 0;
  double motor_up_s = 0;    ///< time constant of acceleration; 0: instantaneous
  double motor_down_s = 0;  ///< time constant of deceleration; 0: instantaneous
  double rotor_drag = 0;    ///< drag of a rotor's motion across its axis, N / (rad/s) / (m/s)
  double body_drag = 0;     ///< drag of the body, N / (m/s)²
  /// Ideal over electric power, from the blades to the motor controllers.
  double rotor_efficiency = 0.5;
  double avionics_w = 0;  ///< electric power of everything except the rotors
  double battery_wh = 0;  ///< energy of a full battery; 0: unknown
  /// Impact speeds on a rigid wall above which the propellers that touch it break, and above which
  /// the frame breaks, after which no rotor produces thrust.
  double propeller_limit_mps = 2;
  double structure_limit_mps = 6;
  double attitude_gain_s2 = 70;  ///< angular acceleration per attitude error, 1/s²
  double rate_gain_s = 14;       ///< angular acceleration per error of the body rate, 1/s

  double weight_n() const { return mass_kg * kGravity; }
  double max_thrust_n() const { return 4 * thrust_n_s2 * max_rotor_rad_s * max_rotor_rad_s; }
  /// Radius of the vertical cylinder that encloses the vehicle.
  double radius_m() const { return arm_m + propeller_radius_m; }
  /// Horizontal airspeed that a tilt of 30 degrees sustains (the controller's limit is 35).
  double top_speed_mps() const;
};

/// Parses airframes: an object with one entry per name and the fields of airframes.json. Throws
/// InputError naming `source`, also for a vehicle without enough thrust to hover and steer.
std::vector<Airframe> parse_airframes(std::string_view json, const std::string& source);

/// Reads one airframe: an object with the fields of airframes.json, of which "source" is optional.
/// Adds to `problems`, with JSON pointers that begin with `pointer`.
Airframe read_airframe(const std::string& name, const nlohmann::json& value,
                       const std::string& pointer, std::vector<Problem>& problems);

/// The inverse of read_airframe().
nlohmann::json to_json(const Airframe& airframe);

/// The airframes shipped with the program (spec/sim/airframes.json, which names their sources).
std::vector<Airframe> shipped_airframes();

}  // namespace throng::sim
