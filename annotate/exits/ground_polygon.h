// Projection of polygons on the ground into images.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "camera/camera.h"

namespace throng::annotate {

/// The polygon (m) with additional corners on its sides, so that its projection follows the lens
/// distortion.
std::vector<Eigen::Vector2d> with_short_sides(const std::vector<Eigen::Vector2d>& corners);

/// Appends a JSON array of the projected corners of a polygon (m, at z = 0) in box coordinates. The
/// polygon is clipped to the half-space in front of the camera and to the range of its lens model,
/// but not to the image; the array is empty if no part of the polygon is in the image.
void append_ground_polygon(std::string& text, const std::vector<Eigen::Vector2d>& polygon,
                           const camera::Camera& camera);

}  // namespace throng::annotate
