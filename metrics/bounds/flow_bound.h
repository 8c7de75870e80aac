// The earliest times at which a crowd can be out: an earliest-arrival flow through its exits.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "world/scenario.h"

namespace throng::metrics {

/// Earliest arrival of each person at each door, and the doors' capacity.
struct Departures {
  std::vector<std::vector<double>> access_s;  ///< [person][exit]; infinite: never
  std::vector<double> capacity_per_s;         ///< per exit, people; 0: closed
  std::vector<double> on_s;                   ///< per exit, time from the door out of the scenario
  std::vector<double> closes_at_s = {};       ///< per exit, closing time; empty: none closes
  /// Per exit, the burst in people: at most burst + capacity_per_s * t people pass in any t
  /// consecutive slots, as the arrival curve of Cruz (IEEE Trans. Inf. Theory 37, 1991), enforced
  /// by a token bucket. Empty: each slot takes capacity_per_s people, rounded up.
  std::vector<double> burst = {};
};

/// The earliest times at which people can be out, one per person, sorted; infinite for those who
/// cannot get out. Computed by maximum flow from people to slots of one second at the exits, where
/// people may wait (Ford and Fulkerson 1956). Slots are added in order of time and assigned people
/// stay out, so that the number of people out is maximal at all times: an earliest-arrival flow
/// (Gale 1959). A slot takes people who arrive before its end and lets them out at its start, so
/// that no time is overestimated.
std::vector<double> earliest_out_s(const Departures& departures);

}  // namespace throng::metrics
