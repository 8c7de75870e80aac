// Summary of each drone's flight in a run.
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "world/trace.h"

namespace throng::metrics {

/// Metrics of one drone; docs/metrics.md defines them.
struct DroneFigures {
  std::string id;
  double flown_m = 0;    ///< length of the path
  double energy_wh = 0;  ///< taken from the battery
  double fastest_mps = 0;
  double wind_mps = 0;     ///< mean over time of the wind speed at the drone
  int tilt_saturated = 0;  ///< number of times that its tilt was at the limit
  int blown_away = 0;
  std::map<std::string, int> collisions;  ///< by kind of obstacle
  double hardest_ns = 0;                  ///< max impulse of a collision
  int near_misses = 0;
  std::optional<double> nearest_miss_m;  ///< min distance of all near misses
  int downwash_people = 0;               ///< people exposed to air faster than 5 m/s
  double downwash_person_s = 0;
  std::optional<double> landed_s;  ///< time of the landing due to a low battery
  std::optional<double> battery_flat_s;
  int propellers_broken = 0;
  bool structure_broken = false;
  std::optional<double> falling_s;  ///< start of its fall
  int fall_hazard_people = 0;       ///< people near the predicted ground impact
};

/// Metrics of each drone of the trace. A near miss of two drones counts for both.
std::vector<DroneFigures> drone_figures(const world::Trace& trace);

nlohmann::json to_json(const DroneFigures& figures);

}  // namespace throng::metrics
