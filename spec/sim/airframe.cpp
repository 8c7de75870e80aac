#include "spec/sim/airframe.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/json/json_describe.h"
#include "base/json/json_text.h"
#include "spec/sim/airframe_fields.h"
#include "spec/sim/airframe_rules.h"

namespace throng::embedded {
extern const std::string_view kAirframes;
}

namespace throng::sim {

std::array<Rotor, 4> rotors_in_x(double arm_m) {
  const double seat_m = arm_m / std::sqrt(2.0);
  return {{{{seat_m, seat_m}, -1},
           {{-seat_m, seat_m}, 1},
           {{-seat_m, -seat_m}, -1},
           {{seat_m, -seat_m}, 1}}};
}

Eigen::Matrix4d rotor_mixing(const Airframe& airframe) {
  Eigen::Matrix4d mixing;
  for (std::size_t i = 0; i < airframe.rotors.size(); ++i) {
    const Rotor& rotor = airframe.rotors[i];
    mixing.col(static_cast<int>(i)) << 1, rotor.at_m.y(), -rotor.at_m.x(),
        -rotor.sense * airframe.torque_per_thrust_m;
  }
  return mixing;
}

double Airframe::top_speed_mps() const {
  // body_drag v² + linear v = weight tan(tilt), the rotors turning as in hover.
  constexpr double kMarginRad = 5 * kDegree;
  const double linear = 4 * rotor_drag * std::sqrt(weight_n() / (4 * thrust_n_s2));
  const double force_n = weight_n() * std::tan(autopilot.max_tilt_rad - kMarginRad);
  return 2 * force_n / (linear + std::sqrt(linear * linear + 4 * body_drag.x() * force_n));
}

namespace {

Airframe read_at(const std::string& name, const nlohmann::json& value,
                 const fields::FieldLocation& place) {
  Airframe frame;
  frame.name = name;
  airframe_fields().read_checked(value, frame, place);
  if (!value.is_object()) return frame;
  if (!value.contains("rotors")) frame.rotors = rotors_in_x(frame.arm_m);
  check_airframe(frame, value, place);
  return frame;
}

}  // namespace

Airframe read_airframe(const std::string& name, const nlohmann::json& value,
                       const std::string& pointer, std::vector<Problem>& problems) {
  const std::string source;
  return read_at(name, value, {pointer, source, problems});
}

nlohmann::json to_json(const Airframe& airframe) { return airframe_fields().print(airframe); }

std::vector<Airframe> parse_airframes(std::string_view json, const std::string& source) {
  const nlohmann::json document = parse_json(json, source);
  std::vector<Problem> problems;
  const fields::FieldLocation root{"", source, problems};
  std::vector<Airframe> frames;
  if (document.is_object()) {
    for (const auto& [name, value] : document.items()) {
      const std::size_t before = problems.size();
      Airframe frame = read_at(name, value, root.below(name));
      if (problems.size() == before) frames.push_back(std::move(frame));
    }
  } else {
    root.reject(describe(document), "an object with one airframe per name");
  }
  if (!problems.empty()) throw InputError(std::move(problems));
  return frames;
}

std::vector<Airframe> shipped_airframes() {
  return parse_airframes(embedded::kAirframes, "airframes.json");
}

std::optional<Airframe> find_airframe(const std::string& name) {
  for (Airframe& airframe : shipped_airframes()) {
    if (airframe.name == name) return std::move(airframe);
  }
  return std::nullopt;
}

}  // namespace throng::sim
