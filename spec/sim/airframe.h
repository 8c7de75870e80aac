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
  double arm_m = 0;     ///< center to rotor axis
  double height_m = 0;  ///< of the body, for collisions
  double propeller_radius_m = 0;
  Eigen::Vector3d inertia = Eigen::Vector3d::Zero();  ///< kg m², about x (ahead), y (left), z (up)
  double thrust_n_s2 = 0;                             ///< a rotor's thrust / speed²
  double torque_per_thrust_m = 0;                     ///< a rotor's reaction torque / its thrust
  double max_rotor_rad_s = 0;
  double motor_up_s = 0;          ///< time constant when speeding up; 0: at once
  double motor_down_s = 0;        ///< time constant when slowing down
  double rotor_drag = 0;          ///< N / (rad/s) / (m/s) per rotor, against motion across its axis
  double body_drag = 0;           ///< N / (m/s)²
  double rotor_efficiency = 0.5;  ///< ideal power / electric power, blades to motor controllers
  double avionics_w = 0;          ///< power of everything but the rotors
  double battery_wh = 0;          ///< what a full battery holds; 0: not known
  /// Speed of an impact on a rigid wall above which the propellers that it reaches break, and
  /// above which the frame does, after which no rotor gives thrust.
  double propeller_limit_mps = 2;
  double structure_limit_mps = 6;
  double attitude_gain_s2 = 70;  ///< angular acceleration per attitude error
  double rate_gain_s = 14;       ///< angular acceleration per body rate

  double weight_n() const { return mass_kg * kGravity; }
  double max_thrust_n() const { return 4 * thrust_n_s2 * max_rotor_rad_s * max_rotor_rad_s; }
  /// Radius of the vertical cylinder that holds the vehicle.
  double radius_m() const { return arm_m + propeller_radius_m; }
  /// Speed through still air that a tilt of 30 degrees sustains (the controller may use 35).
  double top_speed_mps() const;
};

/// Reads airframes: an object with one entry per name; fields as in airframes.json. Throws
/// InputError, also for a vehicle whose rotors cannot lift it with a reserve for steering.
std::vector<Airframe> parse_airframes(std::string_view json, const std::string& source);

/// One airframe: an object with the fields of airframes.json, of which "source" may be left out.
/// Adds what is wrong to `problems`, with pointers that begin with `pointer`.
Airframe read_airframe(const std::string& name, const nlohmann::json& value,
                       const std::string& pointer, std::vector<Problem>& problems);

/// The object that read_airframe() reads back.
nlohmann::json to_json(const Airframe& airframe);

/// The airframes that come with the program (spec/sim/airframes.json, with their sources).
std::vector<Airframe> shipped_airframes();

}  // namespace throng::sim
