#include "spec/job/guidance_spec.h"

#include <fmt/core.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/geometry/angle.h"

namespace throng::jobs {

using nlohmann::json;
using nlohmann::ordered_json;

namespace {

constexpr std::array kPerceptionWords{"truth", "camera"};
/// Those of the table of sim/policies/policy_table.cpp.
constexpr std::array kPolicies{"hover",  "waypoints", "orbit",   "survey", "follow_density",
                               "zigzag", "pilot_log", "balance", "signage"};

json fov_json(const sim::PerceptionSpec& spec) { return spec.fov_rad / kDegree; }

void set_fov(sim::PerceptionSpec& spec, const json& value, const FieldLocation& /*place*/) {
  spec.fov_rad = value.get<double>() * kDegree;
}

const FieldTable<sim::PerceptionSpec>& perception_fields() {
  static const FieldTable<sim::PerceptionSpec> fields = [] {
    FieldTable<sim::PerceptionSpec> table;
    table
        .add_word("kind", "Kind", kPerceptionWords, at(&sim::PerceptionSpec::kind),
                  "truth: all people's positions and goals; camera: the count of a camera that "
                  "looks straight "
                  "down from the drone. Default: truth.")
        .without_default();
    table
        .add("fov_deg", "Field of view", "degrees", numbers(10, 170), fov_json, set_fov,
             "camera: opening angle of its cone of view; default: 90.")
        .without_default();
    table
        .add("delay_s", "Delay", "s", numbers(0, 60), at(&sim::PerceptionSpec::delay_s),
             "camera: delay from the image to the estimate; default: 1.")
        .without_default();
    table
        .add("count_noise", "Count noise", "", numbers(0, 0.5),
             at(&sim::PerceptionSpec::count_noise),
             "camera: share of the people that it misses, and of those that it counts twice; "
             "default: 0.1.")
        .without_default();
    return table;
  }();
  return fields;
}

const FieldTable<world::Rectangle>& area_fields() {
  static const FieldTable<world::Rectangle> fields = [] {
    FieldTable<world::Rectangle> table;
    table.add("min", "Min corner", "m", coordinates(2), at(&world::Rectangle::min), "[x, y].")
        .required();
    table.add("max", "Max corner", "m", coordinates(2), at(&world::Rectangle::max), "[x, y].")
        .required();
    return table;
  }();
  return fields;
}

json perception_json(const DroneSpec& drone) {
  const auto& perception = drone.mission.guidance.perception;
  return perception ? perception_fields().print(*perception) : json();
}

void set_perception(DroneSpec& drone, const json& value, const FieldLocation& place) {
  perception_fields().read(value, drone.mission.guidance.perception.emplace(), place);
}

json area_json(const DroneSpec& drone) {
  const auto& area = drone.mission.guidance.area;
  return area ? area_fields().print(*area) : json();
}

void set_area(DroneSpec& drone, const json& value, const FieldLocation& place) {
  area_fields().read(value, drone.mission.guidance.area.emplace(), place);
}

ordered_json waypoint_rules() {
  ordered_json rules = {{"title", "Point"},
                        {"description", "[x, y, z] in the world: Z up, the ground is z = 0."}};
  rules.update(coordinates(3).rules);
  return rules;
}

json waypoints_json(const DroneSpec& drone) {
  json list;
  for (const Eigen::Vector3d& point : drone.mission.waypoints) list.push_back(value_json(point));
  return list;
}

void set_waypoints(DroneSpec& drone, const json& value, const FieldLocation& /*place*/) {
  drone.mission.waypoints.clear();
  for (const json& point : value) set_value(point, drone.mission.waypoints.emplace_back());
}

json exits_json(const DroneSpec& drone) {
  const std::vector<std::string>& exits = drone.mission.guidance.exits;
  return exits.empty() ? json() : json(exits);
}

void set_exits(DroneSpec& drone, const json& value, const FieldLocation& /*place*/) {
  value.get_to(drone.mission.guidance.exits);
}

json log_json(const DroneSpec& drone) { return value_json(drone.pilot_log.filename().string()); }

void set_log(DroneSpec& drone, const json& value, const FieldLocation& place) {
  const auto name = value.get<std::string>();
  if (place.source.empty()) {
    place.problems.push_back({"", place.pointer, "\"" + name + "\"",
                              "set-points, since a request has no files beside it"});
    return;
  }
  drone.pilot_log = std::filesystem::path(place.source).parent_path() / name;
}

constexpr std::size_t kSetpointNumbers = 6;
constexpr std::size_t kGimbalSetpointNumbers = 8;

ordered_json setpoint_rules() {
  ordered_json rules = {
      {"title", "Set-point"},
      {"description",
       "[time in s, x, y, z, yaw in degrees from +x, 1 while people can follow], and, where the "
       "gimbal turns the camera, its pitch and yaw in degrees instead of camera.pitch_deg and "
       "yaw_deg."}};
  rules.update(coordinates(kSetpointNumbers).rules);
  rules["maxItems"] = kGimbalSetpointNumbers;
  return rules;
}

/// Degrees that are read back as the same angle: a job is printed and read several times on its
/// way.
double to_degrees(double angle_rad) {
  constexpr double kParts = 1e9;
  const double degrees = angle_rad / kDegree;
  const double rounded = std::round(degrees * kParts) / kParts;
  return rounded * kDegree == angle_rad ? rounded : degrees;
}

json setpoints_json(const DroneSpec& drone) {
  json list;
  for (const sim::PilotSample& sample : drone.mission.guidance.setpoints) {
    json& row = list.emplace_back(json{sample.time_s, sample.position.x(), sample.position.y(),
                                       sample.position.z(), to_degrees(sample.yaw_rad),
                                       sample.beacon ? 1 : 0});
    if (!sample.gimbal) continue;
    row.push_back(sample.gimbal->pitch_deg);
    row.push_back(sample.gimbal->yaw_deg);
  }
  return list;
}

/// The direction of the gimbal in a set-point. Adds a problem for one that no gimbal has.
camera::GimbalAngles read_gimbal(const json& row, const FieldLocation& place) {
  const auto angle = [&](std::size_t index, double min, double max) {
    const auto value = row[index].get<double>();
    if (value < min || value > max) {
      place.problems.push_back({"", place.below(std::to_string(index)).pointer,
                                fmt::format("{:g} degrees", value),
                                fmt::format("{:g} to {:g} degrees", min, max)});
    }
    return value;
  };
  return {angle(kSetpointNumbers, camera::kMinGimbalPitchDeg, camera::kMaxGimbalPitchDeg),
          angle(kSetpointNumbers + 1, -camera::kMaxGimbalYawDeg, camera::kMaxGimbalYawDeg)};
}

void set_setpoints(DroneSpec& drone, const json& value, const FieldLocation& place) {
  std::vector<sim::PilotSample>& setpoints = drone.mission.guidance.setpoints;
  setpoints.clear();
  for (std::size_t i = 0; i < value.size(); ++i) {
    const json& row = value[i];
    sim::PilotSample& sample = setpoints.emplace_back(
        sim::PilotSample{row[0].get<double>(),
                         {row[1].get<double>(), row[2].get<double>(), row[3].get<double>()},
                         row[4].get<double>() * kDegree,
                         row[5].get<double>() != 0});
    if (row.size() == kSetpointNumbers) continue;
    const FieldLocation own = place.below(std::to_string(i));
    if (row.size() == kGimbalSetpointNumbers) {
      sample.gimbal = read_gimbal(row, own);
    } else {
      place.problems.push_back({"", own.pointer, fmt::format("{} numbers", row.size()),
                                fmt::format("{}, or {} with the gimbal's pitch and yaw",
                                            kSetpointNumbers, kGimbalSetpointNumbers)});
    }
  }
}

FieldTable<DroneSpec> make_guidance_fields() {
  FieldTable<DroneSpec> table;
  table.add("policy", "Policy", "", one_of_words(kPolicies),
            at(&DroneSpec::mission, &sim::DroneMission::policy),
            "hover: stay at the start; waypoints: fly from point to point and hover at the last; "
            "orbit: circle a point and look at it; survey: lanes over an area; follow_density: "
            "keep the camera on the densest crowd; zigzag: sweep and lead as a human pilot; "
            "pilot_log: repeat recorded set-points; balance: lead people from long queues to short "
            "ones; signage: hover before the best exit and attract people.");
  table
      .add("waypoints", "Waypoints", "m", lists(0, 1000, waypoint_rules()), waypoints_json,
           set_waypoints, R"(The points of the policy "waypoints", in order.)")
      .with_default(ordered_json::array());
  table
      .add("speed_mps", "Speed", "m/s", numbers(0.1, 15),
           at(&DroneSpec::mission, &sim::DroneMission::speed_mps), "Speed along the path.")
      .randomized();
  table.add(
      "lead_speed_mps", "Speed with followers", "m/s", numbers(0.1, 10),
      at(&DroneSpec::mission, &sim::DroneMission::guidance, &sim::GuidanceSpec::lead_speed_mps),
      "balance: speed at which it leads people; default: 1.6.");
  table.add("batch", "Batch", "people", integers(1, 10000),
            at(&DroneSpec::mission, &sim::DroneMission::guidance, &sim::GuidanceSpec::batch),
            "balance: max people that it leads at once; default: 50.");
  table
      .add("exits", "Exits", "", lists(0, 127, texts(1, 200).rules), exits_json, set_exits,
           "zigzag, balance, signage: ids of the scenario's exits that it may lead to; default: "
           "all open ones.")
      .with_default(ordered_json::array());
  table.add("beacon", "Beacon", "", booleans(),
            at(&DroneSpec::mission, &sim::DroneMission::guidance, &sim::GuidanceSpec::beacon),
            "hover, waypoints, orbit, survey, follow_density: whether people may follow the drone, "
            "all the time; default: false. The other policies decide themselves.");
  table.add("perception", "Perception", "", object_with(perception_fields().schema()),
            perception_json, set_perception, "A policy's information about people.");
  table
      .add("center", "Center", "m", coordinates(2),
           at(&DroneSpec::mission, &sim::DroneMission::guidance, &sim::GuidanceSpec::center),
           "orbit: center of the circle, [x, y].")
      .renamed_from("centre");
  table.add("radius_m", "Radius", "m", numbers(1, 10000),
            at(&DroneSpec::mission, &sim::DroneMission::guidance, &sim::GuidanceSpec::radius_m),
            "orbit: radius of the circle.");
  table.add("area", "Area", "", object_with(area_fields().schema()), area_json, set_area,
            "survey: the rectangle that it covers; default: the one that people must leave.");
  table.add("overlap", "Overlap", "", numbers(0, 0.95),
            at(&DroneSpec::mission, &sim::DroneMission::guidance, &sim::GuidanceSpec::overlap),
            "survey: share of the camera's view that neighboring lanes have in common; without "
            "it, 0.3.");
  table.add("log", "Pilot log", "", texts(1, 1000), log_json, set_log,
            "pilot_log: a file of set-points in the job's folder, as throng simulate --pilot-logs "
            "writes it.");
  table
      .add("setpoints", "Set-points", "", lists(0, 100'000, setpoint_rules()), setpoints_json,
           set_setpoints, "pilot_log: the same in the job itself, by time.")
      .with_default(ordered_json::array());
  return table;
}

}  // namespace

const FieldTable<DroneSpec>& guidance_fields() {
  static const FieldTable<DroneSpec> table = make_guidance_fields();
  return table;
}

void read_guidance(const json& value, const std::string& source, const std::string& pointer,
                   DroneSpec& drone, std::vector<Problem>& problems) {
  guidance_fields().read(value, drone, {pointer, source, problems});
}

json guidance_json(const DroneSpec& drone) { return guidance_fields().print(drone); }

}  // namespace throng::jobs
