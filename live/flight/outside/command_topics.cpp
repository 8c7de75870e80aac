#include "live/flight/outside/command_topics.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "base/error.h"
#include "base/geometry/angle.h"
#include "base/json/json_text.h"
#include "base/text/suggest.h"
#include "live/flight/outside/cdr_reader.h"

namespace throng::live {

using nlohmann::json;

namespace {

constexpr JsonLimits kLimits = {.max_depth = 8, .max_bytes = 1 << 16, .max_values = 1000};
constexpr double kMaxYawRadS = 2 * EIGEN_PI;

std::string shown(const json& value) {
  constexpr std::size_t kShown = 60;
  return value.dump().substr(0, kShown);
}

/// A message of a topic.
struct Message {
  const std::string& topic;
  json value;

  [[noreturn]] void refuse(const std::string& pointer, const std::string& found,
                           const std::string& expected) const {
    throw InputError({topic, pointer, found, expected});
  }
  void allow(std::initializer_list<std::string_view> names) const {
    if (!value.is_object()) refuse("", shown(value), "an object");
    for (const auto& [name, unused] : value.items()) {
      if (std::find(names.begin(), names.end(), name) == names.end()) {
        throw InputError(unknown_name(topic, "", "field", name, {names.begin(), names.size()}));
      }
    }
  }
  /// The x, y and z of a part, those that are missing as 0; commands_from_json() checks them.
  json vector(const char* part) const {
    const json given = value.value(part, json::object());
    if (!given.is_object()) refuse(std::string("/") + part, shown(given), "an object with x, y, z");
    return json::array(
        {given.value("x", json(0)), given.value("y", json(0)), given.value("z", json(0))});
  }
  double number(const json& given, const std::string& pointer, double limit) const {
    if (given.is_number() && std::abs(given.get<double>()) <= limit) return given.get<double>();
    refuse(pointer, shown(given), fmt::format("a number from {:.4g} to {:.4g}", -limit, limit));
  }
};

/// The message in a stamped one, or itself.
Message content(const Message& message, const char* part) {
  if (!message.value.is_object() || !message.value.contains(part)) return message;
  message.allow({"header", part});
  return {message.topic, message.value.at(part)};
}

json velocity_fields(const Message& given) {
  const Message message = content(given, "twist");
  message.allow({"linear", "angular"});
  const json angular = message.vector("angular");
  const double yaw_rad_s = message.number(angular[2], "/angular/z", kMaxYawRadS);
  // Also a velocity of 0 ends a route.
  return {{"velocity_mps", message.vector("linear")},
          {"yaw_rate_deg_s", yaw_rad_s / kDegree},
          {"waypoints_m", json::array()}};
}

/// The member "orientation"; nothing if it is missing or all zeros, which ROS sends where nobody
/// has set it.
std::optional<Eigen::Quaterniond> orientation(const Message& message) {
  if (!message.value.contains("orientation")) return std::nullopt;
  const json& given = message.value.at("orientation");
  Eigen::Vector4d q;
  constexpr std::array kNames = {"x", "y", "z", "w"};
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    const std::string pointer = std::string("/orientation/") + kNames[i];
    q[static_cast<Eigen::Index>(i)] =
        message.number(given.is_object() ? given.value(kNames[i], json(0)) : given, pointer, 1.1);
  }
  if (q.isZero(0)) return std::nullopt;
  constexpr double kTolerance = 0.01;
  if (std::abs(q.squaredNorm() - 1) > kTolerance) {
    message.refuse("/orientation", shown(given), "a quaternion of length 1");
  }
  return Eigen::Quaterniond(q).normalized();
}

/// Adds "yaw_deg" where there is an orientation.
void add_heading(const Message& message, json& fields) {
  if (const auto turn = orientation(message)) {
    const Eigen::Vector3d ahead = *turn * Eigen::Vector3d::UnitX();
    fields["yaw_deg"] = std::atan2(ahead.y(), ahead.x()) / kDegree;
  }
}

json pose_fields(const Message& given) {
  const Message message = content(given, "pose");
  message.allow({"position", "orientation", "yaw_deg", "speed_mps"});
  if (!message.value.contains("position")) message.refuse("/position", "nothing", "x, y and z");
  json fields = {{"position_m", message.vector("position")}};
  add_heading(message, fields);
  for (const char* name : {"yaw_deg", "speed_mps"}) {
    if (message.value.contains(name)) fields[name] = message.value.at(name);
  }
  return fields;
}

json waypoint_fields(const Message& message) {
  message.allow({"waypoints", "orientation", "yaw_deg", "speed_mps"});
  if (!message.value.contains("waypoints")) message.refuse("/waypoints", "nothing", "a list");
  json fields = message.value;
  fields["waypoints_m"] = fields.at("waypoints");
  fields.erase("waypoints");
  fields.erase("orientation");
  add_heading(message, fields);
  return fields;
}

json gimbal_fields(const Message& given) {
  const Message message = content(given, "quaternion");
  message.allow({"pitch_deg", "yaw_deg", "orientation"});
  const auto turn = orientation(message);
  if (!turn) {
    if (!message.value.contains("pitch_deg")) {
      message.refuse("/pitch_deg", "nothing", "degrees above the horizon, or an orientation");
    }
    return {{"gimbal_deg", json::array({message.value.at("pitch_deg"),
                                        message.value.value("yaw_deg", json(0))})}};
  }
  constexpr double kMaxRoll = 0.02;
  if (std::abs((*turn * Eigen::Vector3d::UnitY()).z()) > kMaxRoll) {
    message.refuse("/orientation", shown(message.value.at("orientation")),
                   "an orientation without roll");
  }
  const Eigen::Vector3d ahead = *turn * Eigen::Vector3d::UnitX();
  return {{"gimbal_deg", json::array({std::asin(std::clamp(ahead.z(), -1.0, 1.0)) / kDegree,
                                      std::atan2(ahead.y(), ahead.x()) / kDegree})}};
}

json beacon_fields(const Message& message) {
  message.allow({"data"});
  if (!message.value.contains("data")) message.refuse("/data", "nothing", "true or false");
  return {{"beacon", message.value.at("data")}};
}

void skip_header(CdrReader& reader) {
  reader.number<std::int32_t>();
  reader.number<std::uint32_t>();
  reader.text();
}

json read_vector(CdrReader& reader) {
  json vector = json::object();
  for (const char* name : {"x", "y", "z"}) vector[name] = reader.number<double>();
  return vector;
}

json read_twist(CdrReader& reader) {
  json linear = read_vector(reader);
  return {{"linear", std::move(linear)}, {"angular", read_vector(reader)}};
}

json read_quaternion(CdrReader& reader) {
  json turn = read_vector(reader);
  turn["w"] = reader.number<double>();
  return {{"orientation", std::move(turn)}};
}

json read_pose(CdrReader& reader) {
  json position = read_vector(reader);
  json pose = read_quaternion(reader);
  pose["position"] = std::move(position);
  return pose;
}

/// Poses as waypoints, with the orientation of the last one.
json read_poses(CdrReader& reader, bool are_stamped) {
  json message = {{"waypoints", json::array()}};
  for (auto left = reader.number<std::uint32_t>(); left > 0; --left) {
    if (are_stamped) skip_header(reader);
    json pose = read_pose(reader);
    const json& place = pose.at("position");
    message["waypoints"].push_back({place.at("x"), place.at("y"), place.at("z")});
    message["orientation"] = std::move(pose["orientation"]);
  }
  return message;
}

json read_path(CdrReader& reader) { return read_poses(reader, true); }
json read_pose_array(CdrReader& reader) { return read_poses(reader, false); }

json read_bool(CdrReader& reader) { return {{"data", reader.number<std::uint8_t>() != 0}}; }

/// A message of ROS as a topic takes it in CDR.
struct Schema {
  std::string_view name;  ///< without its package
  json (*read)(CdrReader&);
  bool is_stamped = false;
};

/// A command's topic below the drone's name.
struct Kind {
  std::string_view topic;
  json (*fields)(const Message&);  ///< of a drone's command in the service's API
  std::vector<Schema> schemas;
};

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> kinds = {
      {"cmd_vel", velocity_fields, {{"Twist", read_twist}, {"TwistStamped", read_twist, true}}},
      {"cmd_pose", pose_fields, {{"Pose", read_pose}, {"PoseStamped", read_pose, true}}},
      {"cmd_waypoints",
       waypoint_fields,
       {{"Path", read_path, true}, {"PoseArray", read_pose_array, true}}},
      {"gimbal",
       gimbal_fields,
       {{"Quaternion", read_quaternion}, {"QuaternionStamped", read_quaternion, true}}},
      {"beacon", beacon_fields, {{"Bool", read_bool}}}};
  return kinds;
}

/// The schema of a channel with CDR. Throws InputError.
const Schema& find_schema(const Kind& kind, const PublishedCommand& channel) {
  const std::string_view name = channel.schema_name;
  const std::string_view own = name.substr(name.rfind('/') + 1);
  std::vector<std::string_view> known;
  for (const Schema& schema : kind.schemas) {
    if (schema.name == own) return schema;
    known.push_back(schema.name);
  }
  throw InputError(
      {channel.topic, "schema", fmt::format("cdr with \"{}\"", name),
       known.empty() ? "json" : fmt::format("json, or cdr with {}", fmt::join(known, " or "))});
}

/// Names the fields as the message has them.
Problem renamed(Problem problem, const std::string& topic) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 6> kNames = {
      {{"velocity_mps", "linear"},
       {"waypoints_m", "waypoints"},
       {"position_m", "position"},
       {"beacon", "data"},
       {"gimbal_deg", "pitch_deg and yaw_deg"},
       {"yaw_rate_deg_s", "angular/z"}}};
  constexpr std::string_view kPrefix = "/drones/0";
  if (problem.where.starts_with(kPrefix)) problem.where.erase(0, kPrefix.size());
  for (const auto& [api, own] : kNames) {
    if (problem.where.substr(problem.where.find('/') + 1).starts_with(api)) {
      problem.where.replace(1, api.size(), own);
      break;
    }
  }
  problem.source = topic;
  return problem;
}

}  // namespace

CommandTopics::CommandTopics(std::vector<FlownDrone> drones, std::vector<std::string> names)
    : drones_(std::move(drones)), names_(std::move(names)) {}

CommandTopics::Target CommandTopics::find(const std::string& topic) const {
  std::vector<std::string> topics;
  for (std::size_t drone = 0; drone < names_.size(); ++drone) {
    for (std::size_t kind = 0; kind < kinds().size(); ++kind) {
      topics.push_back(fmt::format("/{}/{}", names_[drone], kinds()[kind].topic));
      if (topics.back() == topic) return {drone, kind};
    }
  }
  const std::vector<std::string_view> known(topics.begin(), topics.end());
  throw InputError(unknown_name("channel", "", "topic", topic, known));
}

void CommandTopics::check(const PublishedCommand& channel) const {
  const Kind& kind = kinds()[find(channel.topic).kind];
  if (channel.encoding == "cdr") {
    find_schema(kind, channel);
  } else if (channel.encoding != "json") {
    throw InputError({channel.topic, "encoding", "\"" + channel.encoding + "\"", "json or cdr"});
  }
}

Commands CommandTopics::read(const PublishedCommand& message) const {
  const Target target = find(message.topic);
  const Kind& kind = kinds()[target.kind];
  json value;
  if (message.encoding == "cdr") {
    const Schema& schema = find_schema(kind, message);
    CdrReader reader(message.bytes, message.topic);
    if (schema.is_stamped) skip_header(reader);
    value = schema.read(reader);
  } else {
    value = parse_json(message.bytes, message.topic, kLimits);
  }
  json fields = kind.fields({message.topic, std::move(value)});
  fields["id"] = drones_[target.drone].id;
  try {
    return commands_from_json({{"drones", json::array({std::move(fields)})}}, drones_);
  } catch (const InputError& error) {
    std::vector<Problem> problems;
    for (const Problem& each : error.problems()) problems.push_back(renamed(each, message.topic));
    throw InputError(std::move(problems));
  }
}

}  // namespace throng::live
