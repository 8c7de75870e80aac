#include "jobs/live/state_message.h"

#include <Eigen/Geometry>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/geometry/angle.h"
#include "jobs/live/onboard_camera.h"

namespace throng::live {

using nlohmann::json;

namespace {

constexpr std::uint8_t kVersion = 2;

json point(const Eigen::Vector2d& p) { return {p.x(), p.y()}; }

json rectangle(const world::Rectangle& r) { return {{"min", point(r.min)}, {"max", point(r.max)}}; }

json buildings_json(const world::Scenario& scenario) {
  json list = json::array();
  for (const world::Building& building : scenario.buildings) {
    json corners = json::array();
    for (const Eigen::Vector2d& corner : building.footprint) corners.push_back(point(corner));
    list.push_back({{"id", building.id}, {"footprint", corners}, {"height_m", building.height_m}});
  }
  return list;
}

json exits_json(const world::Scenario& scenario) {
  json list = json::array();
  for (const world::Exit& exit : scenario.exits) {
    list.push_back(
        {{"id", exit.id}, {"from", point(exit.from)}, {"to", point(exit.to)}, {"open", exit.open}});
  }
  return list;
}

/// Sources of smoke: dangers that stay where they are.
json dangers_json(const world::Scenario& scenario) {
  json list = json::array();
  for (const world::Disaster& disaster : scenario.disasters) {
    if (disaster.kind == world::DisasterKind::attacker) continue;
    list.push_back({{"kind", world::kDisasterKinds.at(static_cast<std::size_t>(disaster.kind))},
                    {"position", point(disaster.position)},
                    {"start_s", disaster.start_s},
                    {"radius_m", disaster.radius_m},
                    {"growth_mps", disaster.growth_mps},
                    {"max_radius_m", disaster.max_radius_m}});
  }
  return list;
}

json drones_json(const Flight& flight) {
  json list = json::array();
  for (const sim::PlannedDrone& drone : flight.drones()) {
    const camera::CameraSpec camera = shown_camera(drone.mission.camera);
    list.push_back({{"id", drone.mission.id},
                    {"start", {drone.start.x(), drone.start.y(), drone.start.z()}},
                    {"yaw_deg", drone.yaw_rad / kDegree},
                    {"leads", drone.moves_goal.has_value()},
                    {"camera",
                     {{"hfov_deg", camera.hfov_deg},
                      {"pitch_deg", camera.pitch_deg},
                      {"yaw_deg", camera.yaw_deg},
                      {"is_rigid", camera.gimbal.is_rigid()}}}});
  }
  return list;
}

}  // namespace

json make_hello(const Flight& flight, const world::Scenario& scenario, double smoke) {
  const world::TraceHeader& header = flight.header();
  json roles = json::array();
  for (const world::AgentRole role : header.role) roles.push_back(static_cast<int>(role));
  return {{"version", kVersion},
          {"scenario", scenario.id},
          {"dt_s", flight.dt_s()},
          {"max_s", kMaxFlightS},
          {"people", header.agent_count()},
          {"roles", std::move(roles)},
          {"states", header.state_names},
          {"drones", drones_json(flight)},
          {"ground", rectangle(scenario.ground)},
          {"inside", rectangle(scenario.inside.bounds)},
          {"buildings", buildings_json(scenario)},
          {"exits", exits_json(scenario)},
          {"smoke", smoke},
          {"dangers", dangers_json(scenario)},
          {"image", {{"width", ImageSize().width}, {"height", ImageSize().height}}},
          {"max_speed_mps", sim::kMaxRemoteSpeedMps},
          {"max_climb_mps", sim::kMaxRemoteClimbMps},
          {"max_yaw_deg_s", sim::kMaxRemoteYawDegS},
          {"max_gimbal_deg_s", sim::kMaxRemoteGimbalDegS},
          {"min_pitch_deg", camera::kMinGimbalPitchDeg},
          {"max_pitch_deg", camera::kMaxGimbalPitchDeg}};
}

std::string state_bytes(const Moment& moment, double reached_factor, bool paused) {
  const world::CrowdStep& people = *moment.now;
  std::string bytes;
  append_number(bytes, kVersion);
  append_number(bytes, static_cast<std::uint8_t>(paused ? 1 : 0));
  append_number(bytes, static_cast<std::uint16_t>(moment.drones.size()));
  append_number(bytes, static_cast<std::uint32_t>(people.position.size()));
  append_number(bytes, moment.time_s);
  append_number(bytes, static_cast<float>(reached_factor));
  append_number(bytes, moment.sequence);
  for (std::size_t i = 0; i < moment.drones.size(); ++i) {
    const world::DroneSample& drone = moment.flown.drones[i].back();
    for (const double value : drone.position) append_number(bytes, static_cast<float>(value));
    const Eigen::Quaterniond& q = drone.orientation;
    for (const double value : {q.w(), q.x(), q.y(), q.z()}) {
      append_number(bytes, static_cast<float>(value));
    }
    append_number(bytes, static_cast<float>(drone.velocity.norm()));
    const DroneStatus& status = moment.drones[i];
    append_number(bytes,
                  static_cast<std::uint32_t>((status.beacon ? 1 : 0) | (status.on_mission ? 2 : 0) |
                                             (status.running ? 4 : 0)));
    append_number(bytes, static_cast<float>(status.gimbal.pitch_deg));
    append_number(bytes, static_cast<float>(status.gimbal.yaw_deg));
  }
  constexpr float kYawParts = 10'000;
  for (std::size_t i = 0; i < people.position.size(); ++i) {
    append_number(bytes, people.position[i].x());
    append_number(bytes, people.position[i].y());
    const float yaw = geometry::wrapped_rad(people.yaw_rad[i]);
    append_number(bytes, static_cast<std::int16_t>(std::lround(yaw * kYawParts)));
    append_number(bytes, people.state[i]);
    append_number(bytes, people.flags[i]);
  }
  return bytes;
}

std::string image_bytes(const Moment& moment, double time_s, std::size_t drone,
                        const std::string& jpeg) {
  std::string bytes;
  append_number(bytes, time_s);
  append_number(bytes, moment.sequence);
  append_number(bytes, static_cast<std::uint32_t>(drone));
  return bytes + jpeg;
}

}  // namespace throng::live
