// The journeys of people to the exits.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <vector>

#include "metrics/basis/people.h"
#include "metrics/basis/walking_distance.h"
#include "metrics/exits/exits.h"

namespace throng::metrics {

/// A person's path from noticing the alarm (without noticing: from the later of alarm and arrival)
/// to the last passage of a door.
struct Journey {
  std::size_t agent = 0;
  std::size_t exit = 0;  ///< index of the exit
  double from_s = 0;
  double to_s = 0;
  double walked_m = 0;
  std::optional<double> to_used_m;  ///< shortest path to this exit around buildings
  /// Shortest path to the nearest exit that is open at the start.
  std::optional<double> to_nearest_m;
  double speed_ratio = 0;  ///< mean speed over mean desired speed; 0 if the latter is 0
  int stops = 0;           ///< number of times below 0.1 m/s for more than 1 s

  /// Walked length over shortest length; nothing if the latter is unknown or at most 0.5 m, where
  /// the ratio is meaningless.
  std::optional<double> detour(const std::optional<double>& shortest_m) const {
    constexpr double kNoWayM = 0.5;
    if (!shortest_m || *shortest_m <= kNoWayM) return std::nullopt;
    return walked_m / *shortest_m;
  }
};

/// The journeys of people who left through a door, sorted by agent. `distances`:
/// walking_distances().
std::vector<Journey> journeys(const world::Trace& trace, const world::Scenario& scenario,
                              const std::vector<ExitSeries>& exits,
                              const std::vector<PersonRecord>& people,
                              const std::vector<WalkingDistance>& distances);

/// Medians, quantiles and sums over the journeys.
nlohmann::json to_json(const std::vector<Journey>& journeys);

}  // namespace throng::metrics
