// Room of a vehicle among buildings: where plans and live flights may send it.
#pragma once

#include <Eigen/Core>

#include "spec/sim/airframe.h"
#include "world/scenario.h"

namespace throng::sim {

/// Least height (m) of a vehicle's middle above the ground.
double lowest_height_m(const Airframe& frame);

/// A building that is too near to a point (m) for the vehicle; null: none.
const world::Building* building_near(const world::Scenario& scenario, const Eigen::Vector3d& point,
                                     const Airframe& frame);

/// Likewise of the straight path between two points, without its end.
const world::Building* building_between(const world::Scenario& scenario,
                                        const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                                        const Airframe& frame);

}  // namespace throng::sim
