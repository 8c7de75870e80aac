// Planned drones and what their flights recorded.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sim/fleet/flight.h"
#include "sim/policies/policy_table.h"
#include "tests/sim/airframes.h"

namespace throng::sim::testing {

inline constexpr double kInterval = 0.1;

struct FlightRecord {
  std::vector<std::vector<world::DroneSample>> samples;
  std::vector<world::EventRow> events;

  std::vector<world::EventRow> of_type(const std::string& type) const {
    std::vector<world::EventRow> list;
    for (const world::EventRow& event : events) {
      if (event.type == type) list.push_back(event);
    }
    return list;
  }
};

inline PlannedDrone planned_drone(const Eigen::Vector3d& start,
                                  std::vector<Eigen::Vector3d> waypoints, double speed_mps,
                                  double yaw_rad = 0) {
  PlannedDrone drone;
  drone.mission.speed_mps = speed_mps;
  drone.mission.policy = waypoints.empty() ? "hover" : "waypoints";
  drone.mission.waypoints = std::move(waypoints);
  drone.airframe = airframe_named("f450");
  drone.policy = find_policy(drone.mission.policy);
  drone.start = start;
  drone.yaw_rad = yaw_rad;
  return drone;
}

/// People who walk in straight lines.
struct Walker {
  Eigen::Vector2f from;
  Eigen::Vector2f velocity;
};

inline FlightRecord fly_with(const std::vector<PlannedDrone>& drones, double duration_s,
                             const std::vector<Walker>& walkers = {},
                             const std::vector<world::Building>& buildings = {},
                             const FlightWeather& weather = {}, double physics_dt_s = 1.0 / 480) {
  FlightRecord record;
  record.samples.resize(drones.size());
  Flight flight(buildings, drones, kInterval, physics_dt_s,
                {[&](std::size_t drone, const world::DroneSample& sample) {
                   record.samples[drone].push_back(sample);
                 },
                 [&](const world::TraceEvent& event) { record.events.push_back(to_row(event)); }},
                weather);
  const std::vector<std::uint8_t> present(walkers.size(), 1);
  for (int step = 1; step * kInterval < duration_s + 1e-9; ++step) {
    std::vector<Eigen::Vector2f> positions;
    for (const Walker& walker : walkers) {
      positions.push_back(walker.from + static_cast<float>(step * kInterval) * walker.velocity);
    }
    flight.advance({positions, present});
  }
  flight.finish();
  return record;
}

}  // namespace throng::sim::testing
