#include "live/flight/state_message.h"

#include <Eigen/Geometry>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/geometry/angle.h"
#include "live/flight/onboard_camera.h"
#include "spec/layouts/live_records.h"

namespace throng::live {

using nlohmann::json;

namespace {

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

layouts::DroneRecord drone_record(const world::DroneSample& drone, const DroneStatus& status) {
  layouts::DroneRecord record;
  for (std::size_t i = 0; i < 3; ++i) {
    record.position.at(i) = static_cast<float>(drone.position[static_cast<int>(i)]);
  }
  const Eigen::Quaternionf q = drone.orientation.cast<float>();
  record.quaternion = {q.w(), q.x(), q.y(), q.z()};
  record.speed_mps = static_cast<float>(drone.velocity.norm());
  record.flags = (status.beacon ? layouts::kHasBeacon : 0) |
                 (status.on_mission ? layouts::kIsOnMission : 0) |
                 (status.running ? layouts::kIsRunning : 0);
  record.gimbal_deg = {static_cast<float>(status.gimbal.pitch_deg),
                       static_cast<float>(status.gimbal.yaw_deg)};
  return record;
}

}  // namespace

json make_hello(const Flight& flight, const world::Scenario& scenario, double smoke) {
  const world::TraceHeader& header = flight.header();
  json roles = json::array();
  for (const world::AgentRole role : header.role) roles.push_back(static_cast<int>(role));
  return {{"version", layouts::kLiveVersion},
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
  append_value(bytes,
               layouts::StateHead{.flags = paused ? layouts::kIsPaused : std::uint8_t{0},
                                  .drones = static_cast<std::uint16_t>(moment.drones.size()),
                                  .people = static_cast<std::uint32_t>(people.position.size()),
                                  .time_s = moment.time_s,
                                  .factor = static_cast<float>(reached_factor),
                                  .sequence = moment.sequence});
  for (std::size_t i = 0; i < moment.drones.size(); ++i) {
    append_value(bytes, drone_record(moment.flown.drones[i].back(), moment.drones[i]));
  }
  for (std::size_t i = 0; i < people.position.size(); ++i) {
    const float yaw_rad = geometry::wrapped_rad(people.yaw_rad[i]);
    append_value(bytes,
                 layouts::PersonRecord{.position = {people.position[i].x(), people.position[i].y()},
                                       .yaw = static_cast<std::int16_t>(std::lround(
                                           yaw_rad * static_cast<float>(layouts::kYawParts))),
                                       .state = people.state[i],
                                       .flags = people.flags[i]});
  }
  return bytes;
}

std::string image_bytes(const Moment& moment, double time_s, std::size_t drone,
                        const std::string& jpeg) {
  std::string bytes;
  append_value(bytes, layouts::ImageHead{.time_s = time_s,
                                         .sequence = moment.sequence,
                                         .drone = static_cast<std::uint32_t>(drone)});
  return bytes + jpeg;
}

}  // namespace throng::live
