// How soon a crowd could be out at best: the quickest flow through its exits.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "world/scenario.h"

namespace throng::metrics {

/// Earliest arrival of each person at each door, and the doors' capacity.
struct Departures {
  std::vector<std::vector<double>> access_s;  ///< per person and exit; infinite: never
  std::vector<double> capacity_per_s;         ///< per exit, people; 0: closed
  std::vector<double> on_s;                   ///< per exit, from the door out of the scenario
  std::vector<double> closes_at_s = {};       ///< per exit, from when on it is closed; empty: none
  /// Per exit, people beyond `capacity_per_s` times any length of time that pass in it; empty:
  /// none. Then at most burst + capacity_per_s * t people pass in any t slots in a row: the arrival
  /// curve of Cruz (IEEE Trans. Inf. Theory 37, 1991), which a token bucket enforces. Without it
  /// the slots take capacity_per_s each, rounded up.
  std::vector<double> burst = {};
};

/// When people are out at best, one time per person, in order; infinite for those who cannot get
/// out. The maximum flow from people over the exits' slots of one second, in which people may wait
/// (Ford and Fulkerson 1956). Slots open one after another, the earliest first, and who is out
/// stays out, so that as many as can be are out at every time: an earliest-arrival flow (Gale
/// 1959). A slot takes those who come before its end and lets them out at its beginning, so that no
/// time is too long.
std::vector<double> earliest_out_s(const Departures& departures);

/// From a point to beyond the nearest side of the rectangle (m); 0 outside.
double exit_path_m(const world::Rectangle& inside, const Eigen::Vector2d& point);

}  // namespace throng::metrics
