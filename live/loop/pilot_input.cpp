#include "live/loop/pilot_input.h"

#include <algorithm>
#include <array>
#include <memory>
#include <utility>

#include "base/geometry/angle.h"

namespace throng::live {

namespace {

/// A position or waypoints, and the heading and speed for them; null for none.
std::shared_ptr<const sim::RemoteRoute> route_in(const DroneCommand& given) {
  sim::RemoteRoute route;
  const auto add = [&](const std::array<double, 3>& point) {
    route.points.emplace_back(point[0], point[1], point[2]);
  };
  if (given.waypoints_m) std::for_each(given.waypoints_m->begin(), given.waypoints_m->end(), add);
  if (given.position_m) add(*given.position_m);
  if (given.speed_mps) route.speed_mps = *given.speed_mps;
  if (given.yaw_deg) route.yaw_rad = *given.yaw_deg * kDegree;
  if (route.points.empty() && !route.yaw_rad) return nullptr;
  return std::make_shared<const sim::RemoteRoute>(std::move(route));
}

void merge_drone(const DroneCommand& given, sim::RemoteCommand& command) {
  if (given.position_m || given.waypoints_m || given.yaw_deg) {
    command.route = route_in(given);
    command.goes_home = false;
    stop_moving(command);
  }
  if (given.velocity_mps) {
    const auto& [ahead, left, up] = *given.velocity_mps;
    command.velocity_mps = {ahead, left, up};
    // The pilot steers again.
    if (!command.velocity_mps.isZero()) {
      command.goes_home = false;
      command.route = nullptr;
    }
  }
  if (given.yaw_rate_deg_s) command.yaw_rate_deg_s = *given.yaw_rate_deg_s;
  if (given.gimbal_deg) command.gimbal = {(*given.gimbal_deg)[0], (*given.gimbal_deg)[1]};
  if (given.beacon) command.beacon = *given.beacon;
  if (given.return_home) {
    command.goes_home = *given.return_home;
    if (command.goes_home) command.route = nullptr;
  }
}

}  // namespace

void merge(const Commands& given, const std::vector<std::string>& ids, PilotInput& input) {
  const auto number = [&](const std::string& id) {
    return static_cast<std::size_t>(std::find(ids.begin(), ids.end(), id) - ids.begin());
  };
  if (given.sequence) input.sequence = static_cast<std::uint32_t>(*given.sequence);
  if (given.paused) input.paused = *given.paused;
  if (given.factor) input.factor = *given.factor;
  if (given.view) input.view = number(*given.view);
  for (const DroneCommand& drone : given.drones) {
    merge_drone(drone, input.commands.at(number(drone.id)));
  }
}

void stop_moving(sim::RemoteCommand& command) {
  command.velocity_mps.setZero();
  command.yaw_rate_deg_s = 0;
}

}  // namespace throng::live
