#include "spec/sim/airframe_fields.h"

#include <fmt/core.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

namespace throng::sim {

using nlohmann::json;
using world::JsonValue;

namespace {

// Less than this leaves nothing to steer with: 35 degrees of tilt alone take 1.22.
constexpr double kMinThrustToWeight = 1.4;

/// A field with one number, in a closed range. `unit` is what one of it is in SI.
template <typename T>
struct NumberField {
  const char* name;
  double T::*value;
  double low;
  double high;
  double unit = 1;
};

/// A field with a list of numbers, in a closed range.
template <typename T, int N>
struct ListField {
  const char* name;
  Eigen::Matrix<double, N, 1> T::*value;
  const char* expected;
  double low;
  double high;
};

constexpr const char* kHorizontalVertical = "[horizontal, vertical]";
constexpr const char* kAboutAxes = "[about x, about y, about z]";
constexpr const char* kAxes = "[x, y, z]";

constexpr std::array<NumberField<Airframe>, 8> kRequired{{
    {"mass_kg", &Airframe::mass_kg, 1e-3, 100},
    {"arm_m", &Airframe::arm_m, 1e-2, 5},
    {"height_m", &Airframe::height_m, 1e-2, 5},
    {"propeller_radius_m", &Airframe::propeller_radius_m, 1e-3, 5},
    {"thrust_n_s2", &Airframe::thrust_n_s2, 1e-12, 1},
    {"torque_per_thrust_m", &Airframe::torque_per_thrust_m, 1e-6, 1},
    {"max_rotor_rad_s", &Airframe::max_rotor_rad_s, 1, 1e5},
    {"rotor_drag_n_s2_m", &Airframe::rotor_drag, 0, 1},
}};

constexpr std::array<NumberField<Airframe>, 5> kOptional{{
    {"rotor_efficiency", &Airframe::rotor_efficiency, 0.01, 1},
    {"avionics_w", &Airframe::avionics_w, 0, 1e4},
    {"battery_wh", &Airframe::battery_wh, 1e-3, 1e5},
    {"propeller_limit_mps", &Airframe::propeller_limit_mps, 0.1, 1e3},
    {"structure_limit_mps", &Airframe::structure_limit_mps, 0.1, 1e3},
}};

constexpr std::array<NumberField<Airframe>, 2> kMotorLags{{
    {"motor_up_s", &Airframe::motor_up_s, 0, 1},
    {"motor_down_s", &Airframe::motor_down_s, 0, 1},
}};

constexpr std::array<NumberField<ElectricMotor>, 7> kElectric{{
    {"flux_vs", &ElectricMotor::flux_vs, 1e-6, 10},
    {"inertia_kg_m2", &ElectricMotor::inertia_kg_m2, 1e-10, 1},
    {"resistance_ohm", &ElectricMotor::resistance_ohm, 1e-4, 100},
    {"friction_nms", &ElectricMotor::friction_nms, -1e-2, 1e-2},
    {"idle_current_a", &ElectricMotor::idle_current_a, 0, 100},
    {"voltage_share", &ElectricMotor::voltage_share, 0.01, 1},
    {"supply_v", &ElectricMotor::supply_v, 0.1, 1000},
}};

constexpr std::array<NumberField<ElectricMotor>, 2> kInflow{{
    {"inflow_n_s2_m", &ElectricMotor::inflow_n_s2_m, -1, 0},
    {"inflow_n_s2_m2", &ElectricMotor::inflow_n_s2_m2, 0, 10},
}};

constexpr std::array<NumberField<Autopilot>, 12> kAutopilot{{
    {"rate_hz", &Autopilot::rate_hz, 10, 1000},
    {"delay_s", &Autopilot::delay_s, 0, 0.5},
    {"integral_limit_mps2", &Autopilot::integral_limit_mps2, 0, 100},
    {"attitude_gain_s2", &Autopilot::attitude_gain_s2, 1, 1e4},
    {"rate_gain_s", &Autopilot::rate_gain_s, 1, 1e3},
    {"yaw_gain_s", &Autopilot::yaw_gain_s, 0.01, 100},
    {"yaw_rate_gain_s", &Autopilot::yaw_rate_gain_s, 0.01, 1e3},
    {"yaw_rate_damping", &Autopilot::yaw_rate_damping, 0, 10},
    {"turn_drag_share", &Autopilot::turn_drag_share, 0, 1},
    {"max_tilt_deg", &Autopilot::max_tilt_rad, 10, 80, kDegree},
    {"max_yaw_rate_deg_s", &Autopilot::max_yaw_rate_rad_s, 1, 3600, kDegree},
    {"max_thrust_n", &Autopilot::max_thrust_n, 1e-3, 1e5},
}};

constexpr std::array<ListField<Autopilot, 2>, 4> kAutopilotPairs{{
    {"position_gain_s", &Autopilot::position_gain_s, kHorizontalVertical, 0.01, 100},
    {"velocity_gain_s", &Autopilot::velocity_gain_s, kHorizontalVertical, 0.01, 100},
    {"integral_gain_s2", &Autopilot::integral_gain_s2, kHorizontalVertical, 0, 100},
    {"max_speed_mps", &Autopilot::max_speed_mps, kHorizontalVertical, 0.1, 100},
}};

constexpr std::array<ListField<Autopilot, 3>, 1> kAutopilotTriples{{
    {"max_torque_nm", &Autopilot::max_torque_nm, kAboutAxes, 1e-6, 1e4},
}};

constexpr std::array<NumberField<SensorNoise>, 9> kSensors{{
    {"gps_hz", &SensorNoise::gps_hz, 0.1, 1000},
    {"gps_delay_s", &SensorNoise::gps_delay_s, 0, 0.4},
    {"gps_white_m", &SensorNoise::gps_white_m, 0, 100},
    {"gps_wander_s", &SensorNoise::gps_wander_s, 1e-3, 1e6},
    {"pressure_pa", &SensorNoise::pressure_pa, 0, 1e4},
    {"pressure_offset_pa", &SensorNoise::pressure_offset_pa, 0, 1e4},
    {"weather_share", &SensorNoise::weather_share, 0, 0.1},
    {"weather_s", &SensorNoise::weather_s, 1e-3, 1e6},
    {"field_share", &SensorNoise::field_share, 0, 1},
}};

constexpr std::array<ListField<SensorNoise, 2>, 2> kSensorPairs{{
    {"gps_wander_m", &SensorNoise::gps_wander_m, kHorizontalVertical, 0, 1e3},
    {"gps_velocity_mps", &SensorNoise::gps_velocity_mps, kHorizontalVertical, 0, 100},
}};

constexpr std::array<ListField<InertialNoise, 3>, 1> kInertialAxes{{
    {"density", &InertialNoise::density, kAxes, 0, 100},
}};

constexpr std::array<NumberField<InertialNoise>, 3> kInertial{{
    {"walk", &InertialNoise::walk, 0, 100},
    {"walk_s", &InertialNoise::walk_s, 1e-3, 1e6},
    {"turn_on", &InertialNoise::turn_on, 0, 100},
}};

/// Reads the fields that the object has.
template <typename T, std::size_t Count>
void read(const JsonValue& object, const std::array<NumberField<T>, Count>& fields, T& into) {
  for (const NumberField<T>& field : fields) {
    if (const JsonValue given = object[field.name]; given.exists()) {
      into.*field.value = field.unit * given.number(field.low, field.high);
    }
  }
}

template <typename T, int N, std::size_t Count>
void read(const JsonValue& object, const std::array<ListField<T, N>, Count>& fields, T& into) {
  for (const ListField<T, N>& field : fields) {
    const JsonValue given = object[field.name];
    if (!given.exists()) continue;
    const std::vector<JsonValue> numbers = given.tuple(N, field.expected);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      (into.*field.value)[static_cast<int>(i)] = numbers[i].number(field.low, field.high);
    }
  }
}

/// Writes fields; those without a limit are left out.
template <typename T, std::size_t Count>
void write(const T& from, const std::array<NumberField<T>, Count>& fields, json& object) {
  for (const NumberField<T>& field : fields) {
    const double value = from.*field.value / field.unit;
    if (std::isfinite(value)) object[field.name] = value;
  }
}

template <typename T, int N, std::size_t Count>
void write(const T& from, const std::array<ListField<T, N>, Count>& fields, json& object) {
  for (const ListField<T, N>& field : fields) {
    const auto& value = from.*field.value;
    if (value.allFinite()) object[field.name] = std::vector<double>(value.begin(), value.end());
  }
}

/// A number for both, or two.
Eigen::Vector2d read_drag(const JsonValue& value, const char* expected) {
  constexpr double kMaxDrag = 10;
  if (!value.exists()) return Eigen::Vector2d::Zero();
  if (value.is_number()) return Eigen::Vector2d::Constant(value.number(0, kMaxDrag));
  const std::vector<JsonValue> numbers = value.tuple(2, expected);
  if (numbers.empty()) return Eigen::Vector2d::Zero();
  return {numbers[0].number(0, kMaxDrag), numbers[1].number(0, kMaxDrag)};
}

json drag_json(const Eigen::Vector2d& drag) {
  if (drag.x() == drag.y()) return drag.x();
  return {drag.x(), drag.y()};
}

std::array<Rotor, 4> read_rotors(const JsonValue& value, double arm_m) {
  std::array<Rotor, 4> rotors = rotors_in_x(arm_m);
  if (!value.exists()) return rotors;
  const std::vector<JsonValue> given = value.tuple(4, "four rotors");
  for (std::size_t i = 0; i < given.size(); ++i) {
    given[i].fields({"at_m", "turns"});
    const JsonValue turns = given[i]["turns"];
    rotors[i].at_m = given[i]["at_m"].vector2(5);
    rotors[i].sense = turns.text() == "clockwise" ? -1 : 1;
    if (turns.text() != "clockwise" && turns.text() != "counterclockwise") {
      turns.reject("\"clockwise\" or \"counterclockwise\", from above");
    }
  }
  return rotors;
}

Autopilot read_autopilot(const JsonValue& value) {
  Autopilot autopilot;
  if (!value.exists()) return autopilot;
  value.fields({}, {"rate_hz", "delay_s", "position_gain_s", "velocity_gain_s", "integral_gain_s2",
                    "integral_limit_mps2", "attitude_gain_s2", "rate_gain_s", "yaw_gain_s",
                    "yaw_rate_gain_s", "yaw_rate_damping", "turn_drag_share", "max_speed_mps",
                    "max_tilt_deg", "max_yaw_rate_deg_s", "max_thrust_n", "max_torque_nm"});
  read(value, kAutopilot, autopilot);
  read(value, kAutopilotPairs, autopilot);
  read(value, kAutopilotTriples, autopilot);
  return autopilot;
}

std::optional<ElectricMotor> read_electric_motor(const JsonValue& value) {
  if (!value.exists()) return std::nullopt;
  value.fields({"flux_vs", "inertia_kg_m2", "resistance_ohm", "friction_nms", "idle_current_a",
                "voltage_share", "supply_v"},
               {"inflow_n_s2_m", "inflow_n_s2_m2"});
  ElectricMotor motor;
  read(value, kElectric, motor);
  read(value, kInflow, motor);
  return motor;
}

InertialNoise read_inertial(const JsonValue& value, InertialNoise noise) {
  if (!value.exists()) return noise;
  value.fields({}, {"density", "walk", "walk_s", "turn_on"});
  read(value, kInertialAxes, noise);
  read(value, kInertial, noise);
  return noise;
}

SensorNoise read_sensors(const JsonValue& value) {
  SensorNoise noise;
  if (!value.exists()) return noise;
  value.fields({}, {"gyroscope", "accelerometer", "gps_hz", "gps_delay_s", "gps_white_m",
                    "gps_wander_m", "gps_wander_s", "gps_velocity_mps", "pressure_pa",
                    "pressure_offset_pa", "weather_share", "weather_s", "field_share"});
  noise.gyro = read_inertial(value["gyroscope"], noise.gyro);
  noise.accelerometer = read_inertial(value["accelerometer"], noise.accelerometer);
  read(value, kSensors, noise);
  read(value, kSensorPairs, noise);
  return noise;
}

json inertial_json(const InertialNoise& noise) {
  json object;
  write(noise, kInertialAxes, object);
  write(noise, kInertial, object);
  return object;
}

json sensors_json(const SensorNoise& noise) {
  json object = {{"gyroscope", inertial_json(noise.gyro)},
                 {"accelerometer", inertial_json(noise.accelerometer)}};
  write(noise, kSensors, object);
  write(noise, kSensorPairs, object);
  return object;
}

json autopilot_json(const Autopilot& autopilot) {
  json object;
  write(autopilot, kAutopilot, object);
  write(autopilot, kAutopilotPairs, object);
  write(autopilot, kAutopilotTriples, object);
  return object;
}

json rotors_json(const std::array<Rotor, 4>& rotors) {
  json list = json::array();
  for (const Rotor& rotor : rotors) {
    list.push_back({{"at_m", {rotor.at_m.x(), rotor.at_m.y()}},
                    {"turns", rotor.sense < 0 ? "clockwise" : "counterclockwise"}});
  }
  return list;
}

/// Half the shortest distance between two axes.
double free_radius_m(const std::array<Rotor, 4>& rotors) {
  double distance_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < rotors.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      distance_m = std::min(distance_m, (rotors[i].at_m - rotors[j].at_m).norm());
    }
  }
  return 0.5 * distance_m;
}

/// Whether the rotors can turn the vehicle about all axes, one of which counts as 1 for a
/// well-placed quadcopter.
bool can_steer(const Airframe& frame) {
  const Eigen::Matrix4d mixing = rotor_mixing(frame);
  Eigen::Matrix4d scaled = mixing;
  scaled.row(1) /= frame.arm_m;
  scaled.row(2) /= frame.arm_m;
  scaled.row(3) /= frame.torque_per_thrust_m;
  constexpr double kMinDeterminant = 0.1;  // 8 in an X
  return std::abs(scaled.determinant()) > kMinDeterminant;
}

void check_rotors(const Airframe& frame, const JsonValue& value) {
  const double free_m = free_radius_m(frame.rotors);
  if (value["arm_m"].exists() && frame.propeller_radius_m > free_m) {
    value["propeller_radius_m"].reject(
        fmt::format("{:g}", frame.propeller_radius_m),
        fmt::format("at most {:.3g}, where the discs of rotors side by side touch", free_m));
  }
  if (!value["rotors"].exists()) return;
  double max_distance_m = 0;
  for (const Rotor& rotor : frame.rotors) {
    max_distance_m = std::max(max_distance_m, rotor.at_m.norm());
  }
  constexpr double kRoundingM = 1e-3;
  if (std::abs(max_distance_m - frame.arm_m) > kRoundingM) {
    value["arm_m"].reject(
        fmt::format("{:g}", frame.arm_m),
        fmt::format("{:.4g}, the distance of the farthest of the rotors", max_distance_m));
  }
  if (!can_steer(frame)) {
    value["rotors"].reject("rotors that cannot turn the drone about all axes",
                           "two that turn clockwise and two that turn counterclockwise, around "
                           "the center");
  }
}

}  // namespace

Airframe read_airframe_fields(const std::string& name, const JsonValue& value) {
  value.fields(
      {"mass_kg", "arm_m", "height_m", "propeller_radius_m", "inertia_kg_m2", "thrust_n_s2",
       "torque_per_thrust_m", "max_rotor_rad_s", "rotor_drag_n_s2_m", "body_drag_n_s2_m2"},
      {"source", "motor_up_s", "motor_down_s", "electric_motor", "rotors", "turn_drag_nm_s2",
       "rotor_efficiency", "avionics_w", "battery_wh", "propeller_limit_mps", "structure_limit_mps",
       "autopilot", "sensors", "camera"});
  Airframe frame;
  frame.name = name;
  for (const auto& field : kRequired) frame.*field.value = field.low;
  read(value, kRequired, frame);
  read(value, kMotorLags, frame);
  read(value, kOptional, frame);
  const auto inertia = value["inertia_kg_m2"].tuple(3, kAboutAxes);
  for (std::size_t i = 0; i < inertia.size(); ++i) {
    frame.inertia[static_cast<int>(i)] = inertia[i].number(1e-8, 100);
  }
  frame.body_drag = read_drag(value["body_drag_n_s2_m2"], "a number, or two: [across z, along z]");
  frame.turn_drag =
      read_drag(value["turn_drag_nm_s2"], "a number, or two: [about x and y, about z]");
  frame.rotors = read_rotors(value["rotors"], frame.arm_m);
  frame.electric_motor = read_electric_motor(value["electric_motor"]);
  frame.autopilot = read_autopilot(value["autopilot"]);
  frame.sensors = read_sensors(value["sensors"]);
  if (!frame.electric_motor) {
    for (const auto& lag : kMotorLags) {
      if (value[lag.name].exists()) continue;
      value.reject(fmt::format("no \"{}\"", lag.name),
                   fmt::format("a \"{}\", or an \"electric_motor\"", lag.name));
    }
  }
  check_rotors(frame, value);
  if (frame.max_thrust_n() < kMinThrustToWeight * frame.weight_n()) {
    value.reject(fmt::format("rotors that lift {:.3g} N at most, for a weight of {:.3g} N",
                             frame.max_thrust_n(), frame.weight_n()),
                 fmt::format("thrust of at least {} times the weight, to hover and steer",
                             kMinThrustToWeight));
  }
  return frame;
}

json to_json(const Airframe& airframe) {
  const Eigen::Vector3d& inertia = airframe.inertia;
  json value = {{"inertia_kg_m2", {inertia.x(), inertia.y(), inertia.z()}},
                {"rotors", rotors_json(airframe.rotors)},
                {"body_drag_n_s2_m2", drag_json(airframe.body_drag)},
                {"turn_drag_nm_s2", drag_json(airframe.turn_drag)},
                {"autopilot", autopilot_json(airframe.autopilot)},
                {"sensors", sensors_json(airframe.sensors)}};
  write(airframe, kRequired, value);
  write(airframe, kOptional, value);
  if (airframe.battery_wh <= 0) value.erase("battery_wh");
  if (airframe.electric_motor) {
    json motor;
    write(*airframe.electric_motor, kElectric, motor);
    write(*airframe.electric_motor, kInflow, motor);
    value["electric_motor"] = motor;
  } else {
    write(airframe, kMotorLags, value);
  }
  return value;
}

}  // namespace throng::sim
