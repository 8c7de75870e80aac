#include "spec/sim/airframe_fields.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

namespace throng::sim {

using fields::at;
using fields::Field;
using fields::FieldLocation;
using fields::FieldTable;
using fields::Values;
using nlohmann::json;

namespace {

constexpr const char* kHorizontalVertical = "[horizontal, vertical]";
constexpr const char* kAboutAxes = "[about x, about y, about z]";
constexpr std::array kTurns{"clockwise", "counterclockwise"};

/// A number; without a finite value, it is not printed. `unit_si` is one unit of the file in SI.
template <typename Object, typename Access>
Field<Object>& add_number(FieldTable<Object>& table, std::string path, std::string unit, double low,
                          double high, Access access, std::string help, double unit_si = 1) {
  return table.add(
      std::move(path), "", std::move(unit), fields::numbers(low, high),
      [access, unit_si](const Object& object) {
        const double value = access(object) / unit_si;
        return std::isfinite(value) ? json(value) : json();
      },
      [access, unit_si](Object& object, const json& value, const FieldLocation& /*place*/) {
        access(object) = unit_si * value.get<double>();
      },
      std::move(help));
}

/// A list of `count` numbers.
Values number_list(int count, double low, double high, std::string expected) {
  Values values = fields::lists(count, count, fields::numbers(low, high).rules);
  values.expected = std::move(expected);
  return values;
}

/// A vector of numbers; without finite values, it is not printed.
template <typename Access>
Field<Airframe>& add_vector(FieldTable<Airframe>& table, std::string path, std::string unit,
                            double low, double high, std::string expected, Access access,
                            std::string help) {
  using Vector = std::remove_cvref_t<decltype(access(std::declval<Airframe&>()))>;
  return table.add(
      std::move(path), "", std::move(unit),
      number_list(Vector::SizeAtCompileTime, low, high, std::move(expected)),
      [access](const Airframe& frame) {
        const Vector& vector = access(frame);
        return vector.allFinite() ? fields::value_json(vector) : json();
      },
      [access](Airframe& frame, const json& value, const FieldLocation& /*place*/) {
        fields::set_value(value, access(frame));
      },
      std::move(help));
}

/// A drag that is a number for both directions, or two numbers.
Field<Airframe>& add_drag(FieldTable<Airframe>& table, std::string path, std::string unit,
                          Eigen::Vector2d Airframe::*drag, const std::string& directions,
                          std::string help) {
  constexpr double kMaxDrag = 10;
  Values values = fields::numbers(0, kMaxDrag);
  values.rules.update(number_list(2, 0, kMaxDrag, "").rules);
  values.rules["type"] = {"number", "array"};
  values.expected = "a number, or two: " + directions;
  return table.add(
      std::move(path), "", std::move(unit), std::move(values),
      [drag](const Airframe& frame) {
        const Eigen::Vector2d& value = frame.*drag;
        return value.x() == value.y() ? json(value.x()) : fields::value_json(value);
      },
      [drag](Airframe& frame, const json& value, const FieldLocation& /*place*/) {
        if (value.is_number()) {
          frame.*drag = Eigen::Vector2d::Constant(value.get<double>());
        } else {
          fields::set_value(value, frame.*drag);
        }
      },
      std::move(help));
}

const FieldTable<Rotor>& rotor_fields() {
  static const FieldTable<Rotor> fields = [] {
    FieldTable<Rotor> table;
    table
        .add("at_m", "", "m", number_list(2, -5, 5, "[x, y]"), at(&Rotor::at_m),
             "Axis, x ahead and y left of the center of mass.")
        .required();
    table
        .add(
            "turns", "", "", fields::one_of_words(kTurns),
            [](const Rotor& rotor) { return json(kTurns.at(rotor.sense < 0 ? 0 : 1)); },
            [](Rotor& rotor, const json& value, const FieldLocation& /*place*/) {
              rotor.sense = value == kTurns[0] ? -1 : 1;
            },
            "Sense of rotation, from above.")
        .required();
    return table;
  }();
  return fields;
}

json rotors_json(const Airframe& frame) {
  json list = json::array();
  for (const Rotor& rotor : frame.rotors) list.push_back(rotor_fields().print(rotor));
  return list;
}

void set_rotors(Airframe& frame, const json& value, const FieldLocation& place) {
  for (std::size_t i = 0; i < frame.rotors.size(); ++i) {
    rotor_fields().read_checked(value[i], frame.rotors.at(i), place.below(i));
  }
}

const FieldTable<ElectricMotor>& motor_fields() {
  static const FieldTable<ElectricMotor> fields = [] {
    using Motor = ElectricMotor;
    FieldTable<Motor> table;
    add_number(table, "flux_vs", "V s", 1e-6, 10, at(&Motor::flux_vs), "Psi: torque per current.")
        .required();
    add_number(table, "inertia_kg_m2", "kg m²", 1e-10, 1, at(&Motor::inertia_kg_m2),
               "Moment of inertia of motor and propeller.")
        .required();
    add_number(table, "resistance_ohm", "Ω", 1e-4, 100, at(&Motor::resistance_ohm), "R.")
        .required();
    add_number(table, "friction_nms", "N m s", -1e-2, 1e-2, at(&Motor::friction_nms),
               "Torque per speed beside that of the thrust; below 0 where a fit says so.")
        .required();
    add_number(table, "idle_current_a", "A", 0, 100, at(&Motor::idle_current_a), "a.").required();
    add_number(table, "voltage_share", "", 0.01, 1, at(&Motor::voltage_share),
               "b: voltage at the coils over the commanded voltage.")
        .required();
    add_number(table, "supply_v", "V", 0.1, 1000, at(&Motor::supply_v), "Highest voltage.")
        .required();
    add_number(table, "inflow_n_s2_m", "N s²/m", -1, 0, at(&Motor::inflow_n_s2_m),
               "Thrust per speed and per velocity along the axis.");
    add_number(table, "inflow_n_s2_m2", "N s²/m²", 0, 10, at(&Motor::inflow_n_s2_m2),
               "Loss of thrust per square of the velocity along the axis.");
    return table;
  }();
  return fields;
}

void add_body_fields(FieldTable<Airframe>& table) {
  table.add_schema_name();
  table.add_ignored("source", fields::raw({{"type", "string"}}), "Source of the figures.");
  add_number(table, "mass_kg", "kg", 1e-3, 100, at(&Airframe::mass_kg), "Mass of the drone.")
      .required();
  add_number(table, "arm_m", "m", 1e-2, 5, at(&Airframe::arm_m),
             "Distance of the farthest rotor's axis from the middle.")
      .required();
  add_number(table, "height_m", "m", 1e-2, 5, at(&Airframe::height_m),
             "Height of the body, for collisions.")
      .required();
  add_number(table, "propeller_radius_m", "m", 1e-3, 5, at(&Airframe::propeller_radius_m),
             "Radius of a propeller.")
      .required();
  add_vector(table, "inertia_kg_m2", "kg m²", 1e-8, 100, kAboutAxes, at(&Airframe::inertia),
             "Moments of inertia about x (ahead), y (left) and z (up).")
      .required();
  add_drag(table, "body_drag_n_s2_m2", "N s²/m²", &Airframe::body_drag, "[across z, along z]",
           "Drag of the body per square of its speed through the air: for all directions, or "
           "[across z, along z].")
      .required();
  add_drag(
      table, "turn_drag_nm_s2", "N m s²", &Airframe::turn_drag, "[about x and y, about z]",
      "Drag torque of the body per square of its angular velocity: about all axes, or [about x "
      "and y, about z].");
  add_number(
      table, "propeller_limit_mps", "m/s", 0.1, 1e3, at(&Airframe::propeller_limit_mps),
      "Speed of an impact on a rigid wall above which the propellers that it reaches break.");
  add_number(table, "structure_limit_mps", "m/s", 0.1, 1e3, at(&Airframe::structure_limit_mps),
             "Speed of an impact on a rigid wall above which the frame breaks.");
  table.add_ignored("camera",
                    fields::raw({{"type", "object"}}, "an object with fields of a camera"),
                    "Camera that the drone comes with: fields of drones[].camera, which counts "
                    "where it says otherwise (reference/job.md).");
}

/// Time constant of the motors without an equation of their own.
void add_motor_lag(FieldTable<Airframe>& table, const char* path, double Airframe::*lag_s,
                   std::string help) {
  add_number(table, path, "s", 0, 1, at(lag_s), std::move(help)).without_default().get =
      [lag_s](const Airframe& frame) { return frame.electric_motor ? json() : json(frame.*lag_s); };
}

void add_propulsion_fields(FieldTable<Airframe>& table) {
  add_number(table, "thrust_n_s2", "N s²", 1e-12, 1, at(&Airframe::thrust_n_s2),
             "Thrust of a rotor per square of its angular velocity.")
      .required();
  add_number(table, "torque_per_thrust_m", "m", 1e-6, 1, at(&Airframe::torque_per_thrust_m),
             "Reaction torque of a rotor per thrust.")
      .required();
  add_number(table, "max_rotor_rad_s", "rad/s", 1, 1e5, at(&Airframe::max_rotor_rad_s),
             "Maximum angular velocity of a rotor.")
      .required();
  add_number(table, "rotor_drag_n_s2_m", "N s²/m", 0, 1, at(&Airframe::rotor_drag),
             "Drag of a rotor per angular velocity and per speed across its axis.")
      .required();
  add_motor_lag(table, "motor_up_s", &Airframe::motor_up_s,
                "Time constant of a motor that speeds up; required without electric_motor.");
  add_motor_lag(table, "motor_down_s", &Airframe::motor_down_s,
                "Time constant of a motor that slows down; required without electric_motor.");
  table.add_object("electric_motor", motor_fields(), at(&Airframe::electric_motor),
                   "Equation of the motors, in place of motor_up_s and motor_down_s: the current "
                   "at the voltage U and the speed w is t + √(t² + U a / R), t = (U b − Psi w) / "
                   "2R.");
  Values rotors = fields::lists(4, 4, fields::object_with(rotor_fields().schema()).rules);
  rotors.expected = "four rotors";
  table
      .add("rotors", "", "", std::move(rotors), rotors_json, set_rotors,
           "The four rotors; default: in an X on arms of arm_m, the front left one turning "
           "clockwise.")
      .without_default();
  add_number(table, "rotor_efficiency", "", 0.01, 1, at(&Airframe::rotor_efficiency),
             "Ideal power of the rotors per electric power.");
  add_number(table, "avionics_w", "W", 0, 1e4, at(&Airframe::avionics_w),
             "Power of the electronics.");
  add_number(table, "battery_wh", "Wh", 1e-3, 1e5, at(&Airframe::battery_wh),
             "Capacity of the battery; without it, the battery never runs out.")
      .without_default()
      .get = [](const Airframe& frame) {
    return frame.battery_wh > 0 ? json(frame.battery_wh) : json();
  };
}

template <typename Member>
auto pilot(Member Autopilot::*member) {
  return at(&Airframe::autopilot, member);
}

void add_gains(FieldTable<Airframe>& table) {
  table
      .group("autopilot", "",
             "Gains and limits of the autopilot, a cascade from position to angular acceleration. "
             "Pairs are [horizontal, vertical].")
      .without_default();
  add_number(table, "autopilot/rate_hz", "Hz", 10, 1000, pilot(&Autopilot::rate_hz),
             "Decisions a second, a whole number of physics steps apart.");
  add_number(table, "autopilot/delay_s", "s", 0, 0.5, pilot(&Autopilot::delay_s),
             "Time from a decision until the motors have it.");
  add_vector(table, "autopilot/position_gain_s", "1/s", 0.01, 100, kHorizontalVertical,
             pilot(&Autopilot::position_gain_s), "Velocity per position error.");
  add_vector(table, "autopilot/velocity_gain_s", "1/s", 0.01, 100, kHorizontalVertical,
             pilot(&Autopilot::velocity_gain_s), "Acceleration per velocity error.");
  add_vector(table, "autopilot/integral_gain_s2", "1/s²", 0, 100, kHorizontalVertical,
             pilot(&Autopilot::integral_gain_s2),
             "Acceleration per integral of the velocity error.");
  add_number(table, "autopilot/attitude_gain_s2", "1/s²", 1, 1e4,
             pilot(&Autopilot::attitude_gain_s2),
             "Angular acceleration per error of roll and pitch.");
  add_number(table, "autopilot/rate_gain_s", "1/s", 1, 1e3, pilot(&Autopilot::rate_gain_s),
             "Angular acceleration per rate of roll and pitch.");
  add_number(table, "autopilot/yaw_gain_s", "1/s", 0.01, 100, pilot(&Autopilot::yaw_gain_s),
             "Yaw rate per error of yaw.");
  add_number(table, "autopilot/yaw_rate_gain_s", "1/s", 0.01, 1e3,
             pilot(&Autopilot::yaw_rate_gain_s), "Angular acceleration per error of the yaw rate.");
  add_number(table, "autopilot/yaw_rate_damping", "", 0, 10, pilot(&Autopilot::yaw_rate_damping),
             "Share of the yaw's angular acceleration that acts against it.");
  add_number(table, "autopilot/turn_drag_share", "", 0, 1, pilot(&Autopilot::turn_drag_share),
             "Share of the torque of turn_drag_nm_s2 that the autopilot offsets.");
}

void add_limits(FieldTable<Airframe>& table) {
  add_number(table, "autopilot/integral_limit_mps2", "m/s²", 0, 100,
             pilot(&Autopilot::integral_limit_mps2),
             "Limit of the integral's acceleration along each axis; without it, the integral waits "
             "while tilt or speed are at their limits.");
  add_vector(table, "autopilot/max_speed_mps", "m/s", 0.1, 100, kHorizontalVertical,
             pilot(&Autopilot::max_speed_mps), "Speeds at which position errors are corrected.");
  add_number(table, "autopilot/max_tilt_deg", "°", 10, 80, pilot(&Autopilot::max_tilt_rad),
             "Highest tilt.", kDegree);
  add_number(table, "autopilot/max_yaw_rate_deg_s", "°/s", 1, 3600,
             pilot(&Autopilot::max_yaw_rate_rad_s), "Highest yaw rate; default: none.", kDegree);
  add_number(table, "autopilot/max_thrust_n", "N", 1e-3, 1e5, pilot(&Autopilot::max_thrust_n),
             "Highest thrust of all rotors; default: theirs.");
  add_vector(table, "autopilot/max_torque_nm", "N m", 1e-6, 1e4, kAboutAxes,
             pilot(&Autopilot::max_torque_nm), "Highest torques; default: none.");
}

/// The errors of a three-axis sensor.
void add_inertial_fields(FieldTable<Airframe>& table, const std::string& path,
                         InertialNoise SensorNoise::*sensor, const std::string& unit) {
  const auto noise = [&](auto member) { return at(&Airframe::sensors, sensor, member); };
  table.group(path, "", "Errors of a three-axis sensor, in " + unit + ".").without_default();
  add_vector(
      table, path + "/density", "per √Hz", 0, 100, "[x, y, z]", noise(&InertialNoise::density),
      "White noise along each axis; in a reading, over the root of the time since the last.");
  add_number(table, path + "/walk", "per s√Hz", 0, 100, noise(&InertialNoise::walk),
             "Random walk of the variable bias.");
  add_number(table, path + "/walk_s", "s", 1e-3, 1e6, noise(&InertialNoise::walk_s),
             "Correlation time of the variable bias.");
  add_number(table, path + "/turn_on", "", 0, 100, noise(&InertialNoise::turn_on),
             "Standard deviation of the constant bias.");
}

void add_sensor_fields(FieldTable<Airframe>& table) {
  const auto noise = [](auto member) { return at(&Airframe::sensors, member); };
  table
      .group("sensors", "", "Errors of the sensors; docs/drones.md has the source of the defaults.")
      .without_default();
  add_inertial_fields(table, "sensors/gyroscope", &SensorNoise::gyro, "rad/s");
  add_inertial_fields(table, "sensors/accelerometer", &SensorNoise::accelerometer, "m/s²");
  add_number(table, "sensors/gps_hz", "Hz", 0.1, 1000, noise(&SensorNoise::gps_hz),
             "Fixes a second.");
  add_number(table, "sensors/gps_delay_s", "s", 0, 0.4, noise(&SensorNoise::gps_delay_s),
             "Time from a fix until it is known.");
  add_number(table, "sensors/gps_white_m", "m", 0, 100, noise(&SensorNoise::gps_white_m),
             "White noise of a fix, standard deviation.");
  add_vector(table, "sensors/gps_wander_m", "m", 0, 1e3, kHorizontalVertical,
             noise(&SensorNoise::gps_wander_m), "Correlated error of fixes, standard deviation.");
  add_number(table, "sensors/gps_wander_s", "s", 1e-3, 1e6, noise(&SensorNoise::gps_wander_s),
             "Correlation time of this error.");
  add_vector(table, "sensors/gps_velocity_mps", "m/s", 0, 100, kHorizontalVertical,
             noise(&SensorNoise::gps_velocity_mps),
             "White noise of the velocity, standard deviation.");
  add_number(table, "sensors/pressure_pa", "Pa", 0, 1e4, noise(&SensorNoise::pressure_pa),
             "White noise of the barometer, standard deviation.");
  add_number(table, "sensors/pressure_offset_pa", "Pa", 0, 1e4,
             noise(&SensorNoise::pressure_offset_pa),
             "Constant error of the barometer in a run, standard deviation.");
  add_number(table, "sensors/weather_share", "", 0, 0.1, noise(&SensorNoise::weather_share),
             "Standard deviation of the weather's drift, relative to the pressure.");
  add_number(table, "sensors/weather_s", "s", 1e-3, 1e6, noise(&SensorNoise::weather_s),
             "Correlation time of this drift.");
  add_number(table, "sensors/field_share", "", 0, 1, noise(&SensorNoise::field_share),
             "White noise of the magnetometer along each axis, relative to the field.");
}

}  // namespace

const FieldTable<Airframe>& airframe_fields() {
  static const FieldTable<Airframe> fields = [] {
    FieldTable<Airframe> table;
    add_body_fields(table);
    add_propulsion_fields(table);
    add_gains(table);
    add_limits(table);
    add_sensor_fields(table);
    return table;
  }();
  return fields;
}

}  // namespace throng::sim
