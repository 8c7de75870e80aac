// Planned flight paths of a run's drones, without simulating the run.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "spec/sim/run_spec.h"
#include "world/drone_path.h"

namespace throng::sim {

/// The set-points of each drone's policy over the run's duration, as if the drone followed them
/// exactly and its battery never ran out. The path of a policy that depends on people consists of
/// the drone's start only. Drones aim at `people`, or else at people_to_aim_at(). Throws InputError
/// for missions that cannot be flown.
std::vector<world::DronePath> planned_paths(const world::Scenario& scenario, const RunSpec& run,
                                            const std::vector<Eigen::Vector2d>& people);
std::vector<world::DronePath> planned_paths(const world::Scenario& scenario, const RunSpec& run);

/// The set-point of a drone at a time.
struct PlannedPose {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< m
  double yaw_rad = 0;
};

/// The planned poses of each drone, one for each of the ascending `times_s`; empty for a drone
/// whose policy depends on people. Throws InputError as planned_paths().
std::vector<std::vector<PlannedPose>> planned_poses(const world::Scenario& scenario,
                                                    const RunSpec& run,
                                                    const std::vector<Eigen::Vector2d>& people,
                                                    std::span<const double> times_s);

}  // namespace throng::sim
