// Initial poses of images (resection) and positions of points (intersection), for pose.h.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibration/adjustment.h"

namespace throng::calibrate {

/// A known point and the pixel at which an image shows it.
struct Sighting {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
};

/// The pose of an image by least median of squares over random subsets (Rousseeuw 1984), so that up
/// to a third of the sightings may be wrong. Nothing for fewer than four usable sightings, or if no
/// pose explains them. Deterministic.
std::optional<ViewPose> resect(const std::vector<Sighting>& sightings,
                               const camera::Intrinsics& lens);

/// The pixel at which an image shows an unknown point, with the image's pose.
struct Ray {
  camera::Pose pose;
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
};

/// The point nearest to all rays (linear least squares); nothing if no two rays form an angle of
/// one degree, or the point is behind a camera.
std::optional<Eigen::Vector3d> intersect(const std::vector<Ray>& rays,
                                         const camera::Intrinsics& lens);

}  // namespace throng::calibrate
