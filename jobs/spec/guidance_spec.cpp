#include "jobs/spec/guidance_spec.h"

#include <array>
#include <nlohmann/json.hpp>
#include <numbers>

namespace throng::jobs {

using nlohmann::json;

namespace {

constexpr double kGuidanceDegree = std::numbers::pi / 180;
constexpr std::array kPerceptionWords{"truth", "camera"};

Eigen::Vector3d point_of(const json& value) {
  return {value[0].get<double>(), value[1].get<double>(), value[2].get<double>()};
}

Eigen::Vector2d place_of(const json& value) {
  return {value[0].get<double>(), value[1].get<double>()};
}

json json_of(const Eigen::Vector2d& place) { return {place.x(), place.y()}; }

sim::PerceptionSpec perception_of(const json& value) {
  sim::PerceptionSpec spec;
  if (value.value("kind", "truth") == kPerceptionWords[1]) spec.kind = sim::PerceptionKind::camera;
  spec.fov_rad = value.value("fov_deg", spec.fov_rad / kGuidanceDegree) * kGuidanceDegree;
  spec.delay_s = value.value("delay_s", spec.delay_s);
  spec.count_noise = value.value("count_noise", spec.count_noise);
  return spec;
}

json json_of(const sim::PerceptionSpec& spec) {
  return {{"kind", kPerceptionWords[spec.kind == sim::PerceptionKind::camera ? 1 : 0]},
          {"fov_deg", spec.fov_rad / kGuidanceDegree},
          {"delay_s", spec.delay_s},
          {"count_noise", spec.count_noise}};
}

}  // namespace

std::filesystem::path read_guidance(const json& value, const std::string& source,
                                    const std::string& pointer, sim::DroneMission& mission,
                                    std::vector<Problem>& problems) {
  sim::GuidanceSpec& guidance = mission.guidance;
  for (const auto& [key, field] : value.items()) {
    if (key == "policy") field.get_to(mission.policy);
    if (key == "speed_mps") field.get_to(mission.speed_mps);
    if (key == "waypoints") {
      for (const json& point : field) mission.waypoints.push_back(point_of(point));
    }
    if (key == "centre") guidance.center = place_of(field);
    if (key == "radius_m") guidance.radius_m = field.get<double>();
    if (key == "area") guidance.area = {place_of(field["min"]), place_of(field["max"])};
    if (key == "overlap") guidance.overlap = field.get<double>();
    if (key == "exits") field.get_to(guidance.exits);
    if (key == "lead_speed_mps") guidance.lead_speed_mps = field.get<double>();
    if (key == "batch") guidance.batch = field.get<int>();
    if (key == "perception") guidance.perception = perception_of(field);
    if (key == "beacon") guidance.beacon = field.get<bool>();
    if (key == "setpoints") {
      for (const json& row : field) {
        guidance.setpoints.push_back(
            {row[0].get<double>(),
             {row[1].get<double>(), row[2].get<double>(), row[3].get<double>()},
             row[4].get<double>() * kGuidanceDegree,
             row[5].get<double>() != 0});
      }
    }
  }
  if (!value.contains("log")) return {};
  const auto name = value["log"].get<std::string>();
  if (source.empty()) {
    problems.push_back({"", pointer + "/log", "\"" + name + "\"",
                        "set-points, since a request has no files beside it"});
    return {};
  }
  return std::filesystem::path(source).parent_path() / name;
}

json guidance_json(const sim::DroneMission& mission) {
  const sim::GuidanceSpec& guidance = mission.guidance;
  json value = {{"policy", mission.policy}, {"speed_mps", mission.speed_mps}};
  for (const Eigen::Vector3d& point : mission.waypoints) {
    value["waypoints"].push_back({point.x(), point.y(), point.z()});
  }
  if (guidance.center) value["centre"] = json_of(*guidance.center);
  if (guidance.radius_m) value["radius_m"] = *guidance.radius_m;
  if (guidance.area) {
    value["area"] = {{"min", json_of(guidance.area->min)}, {"max", json_of(guidance.area->max)}};
  }
  if (guidance.overlap) value["overlap"] = *guidance.overlap;
  if (!guidance.exits.empty()) value["exits"] = guidance.exits;
  if (guidance.lead_speed_mps) value["lead_speed_mps"] = *guidance.lead_speed_mps;
  if (guidance.batch) value["batch"] = *guidance.batch;
  if (guidance.perception) value["perception"] = json_of(*guidance.perception);
  if (guidance.beacon) value["beacon"] = *guidance.beacon;
  for (const sim::PilotSample& sample : guidance.setpoints) {
    value["setpoints"].push_back({sample.time_s, sample.position.x(), sample.position.y(),
                                  sample.position.z(), sample.yaw_rad / kGuidanceDegree,
                                  sample.beacon ? 1 : 0});
  }
  return value;
}

}  // namespace throng::jobs
