// The camera of a dataset's image, with its lens.
#pragma once

#include "camera/camera.h"
#include "formats/dataset/dataset.h"

namespace throng::formats {

/// As the image's record says it.
camera::Camera image_camera(const Image& image);

/// Pixels that an object of this size covers at a point of the world: for a pinhole fx size / z;
/// with a lens the mean of two directions at right angles to the line of sight, as the lens shows
/// them, or the pinhole's where it shows nothing. Points nearer to the camera's plane than 0.1 m
/// count as that far.
double pixels_across(const camera::Camera& camera, const Eigen::Vector3d& world, double size_m);

/// The place in bbox_amodal for a point of the body, in box coordinates. bbox_amodal is cut off one
/// size of the image beyond its borders (a quarter with a lens): the point is moved to there along
/// each axis, and then lies in bbox_amodal wherever the point is.
Eigen::Vector2d in_amodal_limit(const Image& image, const Eigen::Vector2d& point);

/// Whether bbox_amodal is cut off.
bool reaches_amodal_limit(const Image& image, const Box& box);

}  // namespace throng::formats
