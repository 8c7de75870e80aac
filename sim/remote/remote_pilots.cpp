#include "sim/remote/remote_pilots.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.h"
#include "base/geometry/angle.h"
#include "sim/planning/clearance.h"

namespace throng::sim {

using Eigen::Vector3d;

namespace {

constexpr double kLogAheadS = 0.003;
constexpr double kMaxAccelerationMps2 = 6;
constexpr double kMaxHeightM = 500;
constexpr double kMaxAwayM = 2000;        // from the start
constexpr double kMaxSetpointAheadM = 4;  // of the drone
constexpr double kHomeSpeedMps = 5;
constexpr double kReachedM = 0.5;  // of a point of a route, before the next one
// Between two drones; more than either flies in a step, so that none gets past another unseen.
constexpr double kMinGapM = 2;

// Values that a log's text holds exactly.
double rounded(double value, double parts) { return std::round(value * parts) / parts; }

constexpr double kAngleParts = 1e3;

PilotSample sample_at(double time_s, const Vector3d& position, double yaw_deg, bool beacon) {
  constexpr double kTimeParts = 1e4;
  constexpr double kPlaceParts = 1e4;
  const Vector3d place = position.unaryExpr([](double v) { return rounded(v, kPlaceParts); });
  constexpr double kTurnDeg = 360;
  const double yaw = rounded(std::remainder(yaw_deg, kTurnDeg), kAngleParts);
  return {rounded(time_s + kLogAheadS, kTimeParts), place, yaw * kDegree, beacon};
}

Vector3d limited(Vector3d v) {
  const double over_ground = v.head<2>().norm();
  if (over_ground > kMaxRemoteSpeedMps) v.head<2>() *= kMaxRemoteSpeedMps / over_ground;
  v.z() = std::clamp(v.z(), -kMaxRemoteClimbMps, kMaxRemoteClimbMps);
  return v;
}

}  // namespace

void fly_remotely(RunSpec& spec, const world::Scenario& scenario) {
  for (DroneMission& mission : spec.drones) {
    const auto known = std::find_if(scenario.drones.begin(), scenario.drones.end(),
                                    [&](const auto& drone) { return drone.id == mission.id; });
    const bool is_known = known != scenario.drones.end();
    mission.policy = "pilot_log";
    mission.waypoints.clear();
    mission.guidance = {};
    if (!mission.start && !is_known) continue;
    mission.guidance.setpoints = {sample_at(0, mission.start ? *mission.start : known->position,
                                            is_known ? known->yaw_rad / kDegree : 0, false)};
  }
}

RemotePilots::RemotePilots(const world::Scenario& scenario, SteppedRun& run, const RunSpec& spec)
    : scenario_(scenario),
      run_(run),
      velocities_(spec.drones.size(), Vector3d::Zero()),
      progress_(spec.drones.size()) {
  for (const DroneMission& mission : spec.drones) logs_.push_back(mission.guidance.setpoints);
}

Vector3d RemotePilots::wanted_velocity(std::size_t drone, const RemoteCommand& command) {
  const PilotSample& last = logs_[drone].back();
  Progress& progress = progress_[drone];
  if (progress.route != command.route) progress = {command.route, 0};
  if (command.goes_home) {
    return velocity_to(drone, logs_[drone].front().position, kHomeSpeedMps);
  }
  if (command.route) return kept_near(drone, velocity_along(drone, *command.route));
  const double c = std::cos(last.yaw_rad);
  const double s = std::sin(last.yaw_rad);
  const Vector3d& v = command.velocity_mps;
  return kept_near(drone, limited({c * v.x() - s * v.y(), s * v.x() + c * v.y(), v.z()}));
}

/// Slows down so that the drone stops at the point.
Vector3d RemotePilots::velocity_to(std::size_t drone, const Vector3d& point,
                                   double speed_mps) const {
  const Vector3d way = point - logs_[drone].back().position;
  const double brake_mps = std::sqrt(2 * 0.5 * kMaxAccelerationMps2 * way.norm());
  const double speed = std::min({speed_mps, brake_mps, way.norm() / run_.dt_s()});
  return way.norm() > 0 ? limited(way.normalized() * speed) : Vector3d::Zero();
}

Vector3d RemotePilots::velocity_along(std::size_t drone, const RemoteRoute& route) {
  if (route.points.empty()) return Vector3d::Zero();
  std::size_t& next = progress_[drone].next;
  while (next + 1 < route.points.size() &&
         (route.points[next] - logs_[drone].back().position).norm() < kReachedM) {
    ++next;
  }
  return velocity_to(drone, route.points[next], route.speed_mps);
}

/// No velocity for a set-point that leaves behind a drone that the wind or its strength keeps back.
Vector3d RemotePilots::kept_near(std::size_t drone, const Vector3d& velocity) const {
  const Vector3d ahead = logs_[drone].back().position - run_.drone_state(drone).position;
  const bool leaves = ahead.norm() > kMaxSetpointAheadM && ahead.dot(velocity) > 0;
  return leaves ? Vector3d::Zero() : velocity;
}

double RemotePilots::wanted_yaw_rate(std::size_t drone, const RemoteCommand& command) const {
  double rate_deg_s = command.yaw_rate_deg_s;
  if (!command.goes_home && command.route && command.route->yaw_rad) {
    const double turn_rad =
        std::remainder(*command.route->yaw_rad - logs_[drone].back().yaw_rad, 2 * EIGEN_PI);
    rate_deg_s = turn_rad / kDegree / run_.dt_s();
  }
  return std::clamp(rate_deg_s, -kMaxRemoteYawDegS, kMaxRemoteYawDegS);
}

std::optional<camera::GimbalAngles> RemotePilots::next_gimbal(std::size_t drone,
                                                              const RemoteCommand& command) const {
  const std::optional<camera::GimbalAngles>& last = logs_[drone].back().gimbal;
  const camera::CameraSpec& camera = run_.drones()[drone].mission.camera;
  if (!command.gimbal || camera.gimbal.is_rigid()) return last;
  const camera::GimbalAngles from = last.value_or(camera.gimbal_angles());
  const double max_deg = kMaxRemoteGimbalDegS * run_.dt_s();
  const auto turned = [&](double angle, double wanted, double min, double max) {
    const double target = std::clamp(wanted, min, max);
    return rounded(angle + std::clamp(target - angle, -max_deg, max_deg), kAngleParts);
  };
  return camera::GimbalAngles{turned(from.pitch_deg, command.gimbal->pitch_deg,
                                     camera::kMinGimbalPitchDeg, camera::kMaxGimbalPitchDeg),
                              turned(from.yaw_deg, command.gimbal->yaw_deg,
                                     -camera::kMaxGimbalYawDeg, camera::kMaxGimbalYawDeg)};
}

double RemotePilots::room_m(std::size_t one, const Vector3d& place, std::size_t other) const {
  const Airframe& a = run_.drones()[one].airframe;
  const Airframe& b = run_.drones()[other].airframe;
  const Vector3d way = place - logs_[other].back().position;
  return std::max(way.head<2>().norm() - a.radius_m() - b.radius_m(),
                  std::abs(way.z()) - 0.5 * (a.height_m + b.height_m));
}

bool RemotePilots::is_free(std::size_t drone, const Vector3d& to) const {
  const Airframe& frame = run_.drones()[drone].airframe;
  const Vector3d& from = logs_[drone].back().position;
  const Vector3d& home = logs_[drone].front().position;
  if (to.z() < lowest_height_m(frame) || to.z() > std::max(kMaxHeightM, home.z())) return false;
  if ((to - home).head<2>().norm() > kMaxAwayM) return false;
  if (building_near(scenario_, to, frame) != nullptr ||
      building_between(scenario_, from, to, frame) != nullptr) {
    return false;
  }
  for (std::size_t other = 0; other < logs_.size(); ++other) {
    if (other == drone) continue;
    const double gap_m = room_m(drone, to, other);
    // Away from each other they may always fly.
    if (gap_m < kMinGapM && gap_m < room_m(drone, from, other)) return false;
  }
  return true;
}

void RemotePilots::advance(const std::vector<RemoteCommand>& commands) {
  check(commands.size() == logs_.size(), "every drone has a command");
  const double dt_s = run_.dt_s();
  for (std::size_t i = 0; i < logs_.size(); ++i) {
    const RemoteCommand& command = commands[i];
    const PilotSample last = logs_[i].back();
    Vector3d change = wanted_velocity(i, command) - velocities_[i];
    const double max_change = kMaxAccelerationMps2 * dt_s;
    if (change.norm() > max_change) change *= max_change / change.norm();
    const Vector3d v = velocities_[i] + change;
    // Along a wall, over a roof, or else not at all.
    const std::array<Vector3d, 5> moves = {v, Vector3d(v.x(), v.y(), 0), Vector3d(v.x(), 0, v.z()),
                                           Vector3d(0, v.y(), v.z()), Vector3d(0, 0, v.z())};
    const double yaw_deg = last.yaw_rad / kDegree + wanted_yaw_rate(i, command) * dt_s;
    const double time_s = run_.time_s() + dt_s;
    PilotSample next = sample_at(time_s, last.position, yaw_deg, command.beacon);
    velocities_[i].setZero();
    for (const Vector3d& move : moves) {
      const PilotSample tried =
          sample_at(time_s, last.position + move * dt_s, yaw_deg, command.beacon);
      if (!is_free(i, tried.position)) continue;
      next = tried;
      velocities_[i] = move;
      break;
    }
    next.gimbal = next_gimbal(i, command);
    logs_[i].push_back(next);
    run_.fly_on(i, next);
  }
}

}  // namespace throng::sim
