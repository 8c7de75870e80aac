#include "spec/sim/airframe.h"

#include <fmt/core.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/json/json_text.h"
#include "base/schemas/schemas.h"
#include "world/json_reader.h"

namespace throng::embedded {
extern const std::string_view kAirframes;
}

namespace throng::sim {

namespace {

// Less than this leaves nothing to steer with: 35 degrees of tilt alone take 1.22.
constexpr double kMinThrustToWeight = 1.4;

Airframe read_fields(const std::string& name, const world::JsonValue& value) {
  value.fields({"mass_kg", "arm_m", "height_m", "propeller_radius_m", "inertia_kg_m2",
                "thrust_n_s2", "torque_per_thrust_m", "max_rotor_rad_s", "motor_up_s",
                "motor_down_s", "rotor_drag_n_s2_m", "body_drag_n_s2_m2"},
               {"source", "attitude_gain_s2", "rate_gain_s", "rotor_efficiency", "avionics_w",
                "battery_wh", "propeller_limit_mps", "structure_limit_mps"});
  Airframe frame;
  frame.name = name;
  frame.mass_kg = value["mass_kg"].number(1e-3, 100);
  frame.arm_m = value["arm_m"].number(1e-2, 5);
  frame.height_m = value["height_m"].number(1e-2, 5);
  frame.propeller_radius_m = value["propeller_radius_m"].number(1e-3, 5);
  const auto inertia = value["inertia_kg_m2"].tuple(3, "[about x, about y, about z]");
  for (std::size_t i = 0; i < inertia.size(); ++i) {
    frame.inertia[static_cast<int>(i)] = inertia[i].number(1e-8, 100);
  }
  frame.thrust_n_s2 = value["thrust_n_s2"].number(1e-12, 1);
  frame.torque_per_thrust_m = value["torque_per_thrust_m"].number(1e-6, 1);
  frame.max_rotor_rad_s = value["max_rotor_rad_s"].number(1, 1e5);
  frame.motor_up_s = value["motor_up_s"].number(0, 1);
  frame.motor_down_s = value["motor_down_s"].number(0, 1);
  frame.rotor_drag = value["rotor_drag_n_s2_m"].number(0, 1);
  frame.body_drag = value["body_drag_n_s2_m2"].number(0, 10);
  const auto read = [&](const char* field, double low, double high, double& into) {
    if (const auto given = value[field]; given.exists()) into = given.number(low, high);
  };
  read("attitude_gain_s2", 1, 1e4, frame.attitude_gain_s2);
  read("rate_gain_s", 1, 1e3, frame.rate_gain_s);
  read("rotor_efficiency", 0.01, 1, frame.rotor_efficiency);
  read("avionics_w", 0, 1e4, frame.avionics_w);
  read("battery_wh", 1e-3, 1e5, frame.battery_wh);
  read("propeller_limit_mps", 0.1, 1e3, frame.propeller_limit_mps);
  read("structure_limit_mps", 0.1, 1e3, frame.structure_limit_mps);
  if (value["arm_m"].exists() && frame.propeller_radius_m > frame.arm_m / std::sqrt(2.0)) {
    value["propeller_radius_m"].reject(
        fmt::format("{:g}", frame.propeller_radius_m),
        fmt::format("at most {:.3g}, where the discs of rotors side by side touch",
                    frame.arm_m / std::sqrt(2.0)));
  }
  if (frame.max_thrust_n() < kMinThrustToWeight * frame.weight_n()) {
    value.reject(fmt::format("rotors that lift {:.3g} N at most, for a weight of {:.3g} N",
                             frame.max_thrust_n(), frame.weight_n()),
                 fmt::format("thrust of at least {} times the weight, to hover and steer",
                             kMinThrustToWeight));
  }
  return frame;
}

}  // namespace

double Airframe::top_speed_mps() const {
  // body_drag v² + linear v = weight tan(30°), the rotors turning as in hover.
  const double linear = 4 * rotor_drag * std::sqrt(weight_n() / (4 * thrust_n_s2));
  const double force_n = weight_n() * std::tan(EIGEN_PI / 6);
  return 2 * force_n / (linear + std::sqrt(linear * linear + 4 * body_drag * force_n));
}

Airframe read_airframe(const std::string& name, const nlohmann::json& value,
                       const std::string& pointer, std::vector<Problem>& problems) {
  std::vector<Problem> own;
  const std::string source;
  Airframe frame = read_fields(name, world::JsonValue(value, source, own));
  schemas::add_schema_problems(schemas::Kind::airframe, value, source, own);
  for (Problem& problem : own) {
    if (problem.where == "/") problem.where.clear();
    problem.where = pointer + problem.where;
    problems.push_back(std::move(problem));
  }
  return frame;
}

nlohmann::json to_json(const Airframe& airframe) {
  const Eigen::Vector3d& inertia = airframe.inertia;
  nlohmann::json value = {{"mass_kg", airframe.mass_kg},
                          {"arm_m", airframe.arm_m},
                          {"height_m", airframe.height_m},
                          {"propeller_radius_m", airframe.propeller_radius_m},
                          {"inertia_kg_m2", {inertia.x(), inertia.y(), inertia.z()}},
                          {"thrust_n_s2", airframe.thrust_n_s2},
                          {"torque_per_thrust_m", airframe.torque_per_thrust_m},
                          {"max_rotor_rad_s", airframe.max_rotor_rad_s},
                          {"motor_up_s", airframe.motor_up_s},
                          {"motor_down_s", airframe.motor_down_s},
                          {"rotor_drag_n_s2_m", airframe.rotor_drag},
                          {"body_drag_n_s2_m2", airframe.body_drag},
                          {"attitude_gain_s2", airframe.attitude_gain_s2},
                          {"rate_gain_s", airframe.rate_gain_s},
                          {"rotor_efficiency", airframe.rotor_efficiency},
                          {"avionics_w", airframe.avionics_w},
                          {"propeller_limit_mps", airframe.propeller_limit_mps},
                          {"structure_limit_mps", airframe.structure_limit_mps}};
  if (airframe.battery_wh > 0) value["battery_wh"] = airframe.battery_wh;
  return value;
}

std::vector<Airframe> parse_airframes(std::string_view json, const std::string& source) {
  const nlohmann::json document = parse_json(json, source);
  std::vector<Problem> problems;
  const world::JsonValue root(document, source, problems);
  std::vector<Airframe> frames;
  if (document.is_object()) {
    for (const auto& [name, value] : document.items()) {
      const std::size_t before = problems.size();
      Airframe frame = read_fields(name, root[name]);
      if (problems.size() == before) frames.push_back(std::move(frame));
    }
  } else {
    root.reject("an object with one airframe per name");
  }
  if (!problems.empty()) throw InputError(std::move(problems));
  return frames;
}

std::vector<Airframe> shipped_airframes() {
  return parse_airframes(embedded::kAirframes, "airframes.json");
}

}  // namespace throng::sim
