// Planned flight paths of a run's drones, without simulating the run.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "spec/sim/run_spec.h"
#include "world/drone_path.h"

namespace throng::sim {

/// The set-points of each drone's policy over the run's duration, as if the drone flew them exactly
/// and its battery lasted. A policy that depends on the people it sees has no path before there are
/// any: only the drone's start. Throws InputError for missions that cannot be flown.
std::vector<world::DronePath> planned_paths(const world::Scenario& scenario, const RunSpec& run);

/// Set-point of a drone at a time.
struct PlannedPose {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< m
  double yaw_rad = 0;
};

/// The same as poses at ascending times (s), one per time; none of a drone whose policy depends on
/// the people it sees. Throws InputError like planned_paths().
std::vector<std::vector<PlannedPose>> planned_poses(const world::Scenario& scenario,
                                                    const RunSpec& run,
                                                    std::span<const double> times_s);

}  // namespace throng::sim
