// Positions of the world on the earth.
#pragma once

#include <Eigen/Core>

#include "formats/files/ros_messages.h"

namespace throng::formats::ros {

/// Position of a point of the world on the ellipsoid WGS 84: the origin lies at this latitude and
/// longitude 0, x leads to the east, y to the north. `sd_m` is the standard deviation of the
/// position, east, north, up.
Fix geodetic_fix(const Eigen::Vector3d& position, double latitude_deg, const Eigen::Vector3d& sd_m);

}  // namespace throng::formats::ros
