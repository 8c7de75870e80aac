#include "spec/live/commands.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

#include "base/json/field_table.h"
#include "base/text/suggest.h"
#include "spec/camera/camera_spec.h"

namespace throng::live {

using fields::at;
using fields::FieldLocation;
using fields::FieldTable;
using nlohmann::json;

namespace {

constexpr double kMaxSpeedMps = 20;
constexpr double kMaxYawDegS = 360;
constexpr double kMinFactor = 0.1;
constexpr double kMaxFactor = 10;
constexpr std::int64_t kMaxSequence = 4'294'967'295;
constexpr int kMaxDrones = 100;
constexpr int kMaxName = 200;

constexpr double kMaxAwayM = 10'000;  // of coordinates
constexpr double kMaxTurnDeg = 360;
constexpr double kMinSpeedMps = 0.1;
constexpr std::size_t kMaxWaypoints = 50;

json velocity_json(const DroneCommand& command) { return fields::value_json(command.velocity_mps); }
json position_json(const DroneCommand& command) { return fields::value_json(command.position_m); }
json gimbal_json(const DroneCommand& command) { return fields::value_json(command.gimbal_deg); }
json waypoints_json(const DroneCommand& command) { return fields::value_json(command.waypoints_m); }

bool is_vector(const json& value, double limit) {
  const auto is_within = [&](const json& number) {
    return number.is_number() && std::abs(number.get<double>()) <= limit;
  };
  return value.is_array() && value.size() == 3 &&
         std::all_of(value.begin(), value.end(), is_within);
}

void refuse_vector(const json& value, double limit, const FieldLocation& place) {
  constexpr std::size_t kShown = 60;
  place.problems.push_back({"", place.pointer, value.dump().substr(0, kShown),
                            fmt::format("3 numbers from {:g} to {:g}", -limit, limit)});
}

void set_velocity(DroneCommand& command, const json& value, const FieldLocation& place) {
  if (!is_vector(value, kMaxSpeedMps)) return refuse_vector(value, kMaxSpeedMps, place);
  fields::set_value(value, command.velocity_mps);
}

void set_position(DroneCommand& command, const json& value, const FieldLocation& place) {
  if (!is_vector(value, kMaxAwayM)) return refuse_vector(value, kMaxAwayM, place);
  fields::set_value(value, command.position_m);
}

void set_waypoints(DroneCommand& command, const json& value, const FieldLocation& place) {
  auto& points = command.waypoints_m.emplace();
  for (std::size_t i = 0; i < value.size(); ++i) {
    if (is_vector(value[i], kMaxAwayM)) {
      fields::set_value(value[i], points.emplace_back());
    } else {
      refuse_vector(value[i], kMaxAwayM, place.below(std::to_string(i)));
    }
  }
}

void set_gimbal(DroneCommand& command, const json& value, const FieldLocation& place) {
  const auto is_angle = [](const json& number, double min, double max) {
    return number.is_number() && number.get<double>() >= min && number.get<double>() <= max;
  };
  using camera::kMaxGimbalPitchDeg;
  using camera::kMaxGimbalYawDeg;
  using camera::kMinGimbalPitchDeg;
  if (value.size() == 2 && is_angle(value[0], kMinGimbalPitchDeg, kMaxGimbalPitchDeg) &&
      is_angle(value[1], -kMaxGimbalYawDeg, kMaxGimbalYawDeg)) {
    return fields::set_value(value, command.gimbal_deg);
  }
  constexpr std::size_t kShown = 60;
  place.problems.push_back(
      {"", place.pointer, value.dump().substr(0, kShown),
       fmt::format("[pitch from {:g} to {:g}, yaw from {:g} to {:g}]", kMinGimbalPitchDeg,
                   kMaxGimbalPitchDeg, -kMaxGimbalYawDeg, kMaxGimbalYawDeg)});
}

const FieldTable<DroneCommand>& drone_fields() {
  static const FieldTable<DroneCommand> fields = [] {
    FieldTable<DroneCommand> table;
    table.add("id", "", "", fields::texts(1, kMaxName), at(&DroneCommand::id), "").required();
    table.add("velocity_mps", "", "m/s", fields::raw({{"type", "array"}}), velocity_json,
              set_velocity, "");
    table.add("yaw_rate_deg_s", "", "degrees/s", fields::numbers(-kMaxYawDegS, kMaxYawDegS),
              at(&DroneCommand::yaw_rate_deg_s), "");
    table.add("position_m", "", "m", fields::raw({{"type", "array"}}), position_json, set_position,
              "");
    table.add("waypoints_m", "", "m", fields::raw({{"type", "array"}, {"maxItems", kMaxWaypoints}}),
              waypoints_json, set_waypoints, "");
    table.add("yaw_deg", "", "degrees", fields::numbers(-kMaxTurnDeg, kMaxTurnDeg),
              at(&DroneCommand::yaw_deg), "");
    table.add("speed_mps", "", "m/s", fields::numbers(kMinSpeedMps, kMaxSpeedMps),
              at(&DroneCommand::speed_mps), "");
    table.add("gimbal_deg", "", "degrees", fields::raw({{"type", "array"}}), gimbal_json,
              set_gimbal, "");
    table.add("beacon", "", "", fields::booleans(), at(&DroneCommand::beacon), "");
    table.add("return_home", "", "", fields::booleans(), at(&DroneCommand::return_home), "");
    return table;
  }();
  return fields;
}

json drones_json(const Commands& commands) {
  json list = json::array();
  for (const DroneCommand& drone : commands.drones) list.push_back(drone_fields().print(drone));
  return list;
}

void set_drones(Commands& commands, const json& value, const FieldLocation& place) {
  for (std::size_t i = 0; i < value.size(); ++i) {
    drone_fields().read_checked(value[i], commands.drones.emplace_back(),
                                place.below(std::to_string(i)));
  }
}

const FieldTable<Commands>& command_fields() {
  static const FieldTable<Commands> fields = [] {
    FieldTable<Commands> table;
    table.add("sequence", "", "", fields::integers(0, kMaxSequence), at(&Commands::sequence), "");
    table.add("paused", "", "", fields::booleans(), at(&Commands::paused), "");
    table.add("factor", "", "", fields::numbers(kMinFactor, kMaxFactor), at(&Commands::factor), "");
    table.add("view", "", "", fields::texts(1, kMaxName), at(&Commands::view), "");
    table.add("drones", "", "", fields::raw({{"type", "array"}, {"maxItems", kMaxDrones}}),
              drones_json, set_drones, "");
    return table;
  }();
  return fields;
}

/// The drone with an id; null, with a problem, if there is none.
const FlownDrone* require_drone(const std::string& id, const std::vector<FlownDrone>& drones,
                                const std::string& pointer, std::vector<Problem>& problems) {
  std::vector<std::string_view> names;
  for (const FlownDrone& drone : drones) {
    if (drone.id == id) return &drone;
    names.push_back(drone.id);
  }
  problems.push_back(unknown_name("", pointer, "drone", id, names));
  return nullptr;
}

}  // namespace

Commands commands_from_json(const json& value, const std::vector<FlownDrone>& drones) {
  Commands commands;
  std::vector<Problem> problems;
  const std::string no_source;
  command_fields().read_checked(value, commands, {"", no_source, problems});
  if (commands.view) require_drone(*commands.view, drones, "/view", problems);
  for (std::size_t i = 0; i < commands.drones.size(); ++i) {
    if (commands.drones[i].id.empty()) continue;  // reported already
    const std::string pointer = "/drones/" + std::to_string(i);
    const FlownDrone* drone =
        require_drone(commands.drones[i].id, drones, pointer + "/id", problems);
    if (drone != nullptr && !drone->has_gimbal && commands.drones[i].gimbal_deg) {
      problems.push_back({"", pointer + "/gimbal_deg", "a direction for a rigid camera",
                          "none: the job's camera has gimbal.model rigid"});
    }
  }
  if (!problems.empty()) throw InputError(std::move(problems));
  return commands;
}

json to_json(const Commands& commands) { return command_fields().print(commands); }

}  // namespace throng::live
