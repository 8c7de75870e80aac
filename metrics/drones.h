// Summary of each drone's flight in a run.
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "world/trace.h"

namespace throng::metrics {

struct DroneFigures {
  std::string id;
  double flown_m = 0;    ///< path length in the world
  double energy_wh = 0;  ///< taken from the battery
  double fastest_mps = 0;
  double wind_mps = 0;     ///< mean over time of the air's speed where the drone was
  int tilt_saturated = 0;  ///< times that it could not lean as far as it had to
  int blown_away = 0;
  std::map<std::string, int> collisions;  ///< by what was hit
  double hardest_ns = 0;                  ///< greatest impulse of a collision
  int near_misses = 0;
  std::optional<double> nearest_miss_m;  ///< least distance of all near misses
  int downwash_people = 0;               ///< who stood in air faster than 5 m/s
  double downwash_person_s = 0;
  std::optional<double> landed_s;  ///< when a low battery had brought it down
  std::optional<double> battery_flat_s;
  int propellers_broken = 0;
  bool structure_broken = false;
  std::optional<double> falling_s;  ///< when it began to fall
  int fall_hazard_people = 0;       ///< near the place where the fall would end
};

/// One entry per drone of the trace. Two drones that come near each other have one near miss, which
/// counts for both.
std::vector<DroneFigures> drone_figures(const world::Trace& trace);

nlohmann::json to_json(const DroneFigures& figures);

}  // namespace throng::metrics
