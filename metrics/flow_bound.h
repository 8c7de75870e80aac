// How soon a crowd could be out at best: the quickest flow through its exits.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "world/scenario.h"

namespace throng::metrics {

/// Who can be at which door when, and what the doors take.
struct Departures {
  std::vector<std::vector<double>> access_s;  ///< per person and exit; infinite: never
  std::vector<double> capacity_per_s;         ///< per exit, people; 0: closed
  std::vector<double> on_s;                   ///< per exit, from the door out of the place
  std::vector<double> shuts_s = {};           ///< per exit, from when on it is closed; empty: none
};

/// When people are out at best, one time per person, in order; infinite for those who cannot get
/// out. The maximum flow from people over the exits' slots of one second, in which people may wait
/// (Ford and Fulkerson 1956). Slots open one after another, the earliest first, and who is out
/// stays out, so that as many as can be are out at every time: an earliest-arrival flow (Gale
/// 1959). A slot takes whoever comes before its end and lets them out at its beginning, so that no
/// time is too long.
std::vector<double> earliest_out_s(const Departures& departures);

/// From a door's middle to beyond the nearest side of the rectangle (m); 0 outside.
double way_out_m(const world::Rectangle& inside, const Eigen::Vector2d& door);

struct BoundSpec {
  double speed_mps = 2;                ///< of everybody, from the alarm on
  std::vector<double> capacity_per_s;  ///< per exit of the scenario, people
};

/// Times from the alarm (s).
struct FlowBound {
  double t50_s = 0;
  double t90_s = 0;
  double t100_s = 0;
  double mean_s = 0;
};

/// For any guidance whatever: everybody knows of the alarm at once, goes straight to any open exit
/// through all walls, queues there at most as the exit's capacity demands, and goes straight on out
/// of `Scenario::inside`. Zeros when there is nobody; infinite when no exit is open.
FlowBound flow_bound(const world::Scenario& place, const std::vector<Eigen::Vector2d>& people,
                     const BoundSpec& spec);

}  // namespace throng::metrics
