// Camera pose from world points and the directions in which the camera sees them
// (perspective-n-point).
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "calibration/adjustment.h"

namespace throng::calibrate {

/// The pose that shows the points in these directions (x / z, y / z) with the least algebraic
/// error: SQPnP of Terzakis and Lourakis (2020), for four points or more, coplanar or not. Nothing
/// if no solution has the points in front of the camera.
std::optional<ViewPose> pose_from_directions(const std::vector<Eigen::Vector3d>& points,
                                             const std::vector<Eigen::Vector2d>& directions);

}  // namespace throng::calibrate
