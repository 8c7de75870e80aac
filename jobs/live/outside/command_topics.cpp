#include "jobs/live/outside/command_topics.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/error.h"
#include "base/geometry/angle.h"
#include "base/json/json_text.h"
#include "base/text/suggest.h"
#include "jobs/live/outside/cdr_reader.h"

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

double heading_deg(const Message& message) {
  const json& given = message.value.at("orientation");
  std::array<double, 4> q{};
  constexpr std::array kNames = {"w", "x", "y", "z"};
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    const std::string pointer = std::string("/orientation/") + kNames[i];
    q[i] =
        message.number(given.is_object() ? given.value(kNames[i], json(0)) : given, pointer, 1.1);
  }
  const auto [w, x, y, z] = q;
  constexpr double kTolerance = 0.01;
  if (std::abs(w * w + x * x + y * y + z * z - 1) > kTolerance) {
    message.refuse("/orientation", shown(given), "a quaternion of length 1");
  }
  return std::atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)) / kDegree;
}

json pose_fields(const Message& given) {
  const Message message = content(given, "pose");
  message.allow({"position", "orientation", "yaw_deg", "speed_mps"});
  if (!message.value.contains("position")) message.refuse("/position", "nothing", "x, y and z");
  json fields = {{"position_m", message.vector("position")}};
  if (message.value.contains("orientation")) fields["yaw_deg"] = heading_deg(message);
  for (const char* name : {"yaw_deg", "speed_mps"}) {
    if (message.value.contains(name)) fields[name] = message.value.at(name);
  }
  return fields;
}

json waypoint_fields(const Message& message) {
  message.allow({"waypoints", "yaw_deg", "speed_mps"});
  if (!message.value.contains("waypoints")) message.refuse("/waypoints", "nothing", "a list");
  json fields = message.value;
  fields["waypoints_m"] = fields.at("waypoints");
  fields.erase("waypoints");
  return fields;
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

json read_pose(CdrReader& reader) {
  json position = read_vector(reader);
  json orientation = read_vector(reader);
  orientation["w"] = reader.number<double>();
  return {{"position", std::move(position)}, {"orientation", std::move(orientation)}};
}

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
      {"cmd_waypoints", waypoint_fields, {}},
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
  constexpr std::array<std::pair<std::string_view, std::string_view>, 5> kNames = {
      {{"velocity_mps", "linear"},
       {"waypoints_m", "waypoints"},
       {"position_m", "position"},
       {"beacon", "data"},
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

CommandTopics::CommandTopics(std::vector<std::string> ids, std::vector<std::string> names)
    : ids_(std::move(ids)), names_(std::move(names)) {}

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
  fields["id"] = ids_[target.drone];
  try {
    return commands_from_json({{"drones", json::array({std::move(fields)})}}, ids_);
  } catch (const InputError& error) {
    std::vector<Problem> problems;
    for (const Problem& each : error.problems()) problems.push_back(renamed(each, message.topic));
    throw InputError(std::move(problems));
  }
}

}  // namespace throng::live
