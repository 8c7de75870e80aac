// Camera pose from world points and the directions in which the camera sees them
// (perspective-n-point).
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "camera/calibration/adjustment.h"

namespace throng::calibrate {

/// The pose that shows the points in these directions (x / z, y / z), in the sense of algebraic
/// error: Terzakis and Lourakis' SQPnP (2020), with four points or more, in a plane or not. Nothing
/// when there is none with the points before the camera.
std::optional<ViewPose> pose_from_directions(const std::vector<Eigen::Vector3d>& points,
                                             const std::vector<Eigen::Vector2d>& directions);

}  // namespace throng::calibrate
