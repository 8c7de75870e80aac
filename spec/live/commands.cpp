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
using nlohmann::ordered_json;

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
    const auto list = [] { return fields::raw({{"type", "array"}}); };
    table.add("id", "", "", fields::texts(1, kMaxName), at(&DroneCommand::id), "Id of the drone.")
        .required();
    table.add("velocity_mps", "", "m/s", list(), velocity_json, set_velocity,
              "Velocity [ahead, to the left, up]. Drones fly at most 10 m/s over the ground and "
              "3 m/s up or down.");
    table.add("yaw_rate_deg_s", "", "degrees/s", fields::numbers(-kMaxYawDegS, kMaxYawDegS),
              at(&DroneCommand::yaw_rate_deg_s),
              "Rate of yaw, counter-clockwise; drones turn at most at 120.");
    table.add("position_m", "", "m", list(), position_json, set_position,
              "Point [x, y, z] in the world to fly to, after the waypoints if both are given. The "
              "drone stays there.");
    table.add("waypoints_m", "", "m", fields::raw({{"type", "array"}, {"maxItems", kMaxWaypoints}}),
              waypoints_json, set_waypoints,
              "Points [x, y, z] in the world to fly to one after another; an empty list ends a "
              "flight to points.");
    table.add("yaw_deg", "", "degrees", fields::numbers(-kMaxTurnDeg, kMaxTurnDeg),
              at(&DroneCommand::yaw_deg),
              "Heading to turn to, counter-clockwise from +x. Without points, the drone turns "
              "where it is.");
    table.add("speed_mps", "", "m/s", fields::numbers(kMinSpeedMps, kMaxSpeedMps),
              at(&DroneCommand::speed_mps),
              "Speed on the way to points given with it; default: 5.");
    table.add("gimbal_deg", "", "degrees", list(), gimbal_json, set_gimbal,
              fmt::format("Direction to turn the camera to: [pitch from {:g} to {:g} above the "
                          "horizon, yaw from {:g} to {:g} to the left of the heading]. Gimbals "
                          "turn at most at 60 degrees/s; a rigid camera has none.",
                          camera::kMinGimbalPitchDeg, camera::kMaxGimbalPitchDeg,
                          -camera::kMaxGimbalYawDeg, camera::kMaxGimbalYawDeg));
    table.add("beacon", "", "", fields::booleans(), at(&DroneCommand::beacon),
              "Whether people may follow the drone.");
    table.add("return_home", "", "", fields::booleans(), at(&DroneCommand::return_home),
              "Whether the drone returns to its start, until it is steered again.");
    return table;
  }();
  return fields;
}

/// The schema of lists of `count` numbers.
ordered_json vector_schema(double low, double high, int count) {
  return fields::lists(count, count, fields::numbers(low, high).rules).rules;
}

/// The schema of drone_fields(), with the rules of lists that are checked when they are set.
ordered_json drone_schema() {
  ordered_json schema = drone_fields().schema();
  ordered_json& properties = schema["properties"];
  const ordered_json point = vector_schema(-kMaxAwayM, kMaxAwayM, 3);
  properties["velocity_mps"].update(vector_schema(-kMaxSpeedMps, kMaxSpeedMps, 3));
  properties["position_m"].update(point);
  properties["waypoints_m"]["items"] = point;
  properties["gimbal_deg"].update(
      vector_schema(-camera::kMaxGimbalYawDeg, camera::kMaxGimbalYawDeg, 2));
  schema["type"] = "object";
  return schema;
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
    table.add("sequence", "", "", fields::integers(0, kMaxSequence), at(&Commands::sequence),
              "Number that comes back with the states and images in which the commands are in "
              "force.");
    table.add("paused", "", "", fields::booleans(), at(&Commands::paused),
              "Whether time stands still.");
    table.add("factor", "", "", fields::numbers(kMinFactor, kMaxFactor), at(&Commands::factor),
              "Simulated seconds per second; default at the start: 1.");
    table.add("view", "", "", fields::texts(1, kMaxName), at(&Commands::view),
              "Id of the drone whose camera is shown; default at the start: the first drone.");
    table.add("drones", "", "", fields::raw({{"type", "array"}, {"maxItems", kMaxDrones}}),
              drones_json, set_drones, "Commands of drones.");
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

ordered_json commands_schema() {
  ordered_json schema = command_fields().schema();
  schema["type"] = "object";
  schema["properties"]["drones"]["items"] = drone_schema();
  return schema;
}

}  // namespace throng::live
