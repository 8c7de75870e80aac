// First poses of images and positions of points, for pose.h: resection and intersection.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "camera/calibration/adjustment.h"

namespace throng::calibrate {

/// A known point as an image shows it.
struct Sighting {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
};

/// The pose that most sightings agree with (least median of squares over sampled subsets, Rousseeuw
/// 1984), so that up to a third of them may be wrong. Nothing when no pose shows them.
std::optional<ViewPose> resect(const std::vector<Sighting>& sightings,
                               const camera::Intrinsics& lens);

/// A point as one of several images shows it.
struct Ray {
  camera::Pose pose;
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
};

/// Point nearest to all rays (linear least squares); nothing when they are nearly parallel, or meet
/// behind a camera.
std::optional<Eigen::Vector3d> intersect(const std::vector<Ray>& rays,
                                         const camera::Intrinsics& lens);

}  // namespace throng::calibrate
