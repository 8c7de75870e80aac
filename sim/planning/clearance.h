// Clearance of a vehicle from buildings and the ground, for plans and live flights.
#pragma once

#include <Eigen/Core>

#include "spec/sim/airframe.h"
#include "world/scenario.h"

namespace throng::sim {

/// Min height (m) of a vehicle's center above the ground.
double lowest_height_m(const Airframe& frame);

/// Returns a building that is too close to `point` (m) for the vehicle, or null.
const world::Building* building_near(const world::Scenario& scenario, const Eigen::Vector3d& point,
                                     const Airframe& frame);

/// Returns a building that is too close to the straight path between two points (m) for the
/// vehicle, or null. The end points themselves are not checked.
const world::Building* building_between(const world::Scenario& scenario,
                                        const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                                        const Airframe& frame);

}  // namespace throng::sim
