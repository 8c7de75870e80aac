// How soon a crowd could be out at best: a lower bound for any guidance.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "world/scenario.h"

namespace throng::metrics {

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

/// Everybody knows of the alarm at once, goes straight to any open exit through all walls, queues
/// there at most as the exit's capacity demands, and goes straight on out of `Scenario::inside`.
/// How many can be out by each time is the maximum flow from people to exits over slots of one
/// second; earliest-arrival flows attain all of these at once. Nothing that keeps to the capacities
/// and the speed can be quicker. Zeros when there is nobody; infinite when no exit is open.
FlowBound flow_bound(const world::Scenario& place, const std::vector<Eigen::Vector2d>& people,
                     const BoundSpec& spec);

}  // namespace throng::metrics
