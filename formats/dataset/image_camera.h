// Camera of a dataset's image, with lens distortion.
#pragma once

#include "camera/camera.h"
#include "formats/dataset/dataset.h"

namespace throng::formats {

/// The camera in the image's record.
camera::Camera image_camera(const Image& image);

/// Size in pixels of an object of `size_m` at a point of the world: fx size / z for a pinhole
/// camera; with lens distortion, the mean over two directions perpendicular to the line of sight,
/// or the pinhole's value outside of the lens model's range. Depths below 0.1 m count as 0.1 m.
double pixels_across(const camera::Camera& camera, const Eigen::Vector3d& world, double size_m);

/// A point of a body in box coordinates, clamped to the limits of bbox_amodal, so that it lies in
/// that box. bbox_amodal is cut off one image size beyond the borders (a quarter with lens
/// distortion).
Eigen::Vector2d in_amodal_limit(const Image& image, const Eigen::Vector2d& point);

/// Whether bbox_amodal is cut off.
bool reaches_amodal_limit(const Image& image, const Box& box);

}  // namespace throng::formats
