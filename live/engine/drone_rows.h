// States of drones as rows of numbers.
#pragma once

#include <Eigen/Core>

namespace throng {

/// One row per drone: position and velocity (m, m/s, world), orientation (w, x, y, z, body to
/// world) and body rates (rad/s).
using DroneRows = Eigen::Matrix<double, Eigen::Dynamic, 13, Eigen::RowMajor>;

}  // namespace throng
