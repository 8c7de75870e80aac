// Polygons on the ground as a camera sees them.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "camera/camera.h"

namespace throng::annotate {

/// The polygon (m) with more corners, so that lenses bend its sides as they bend the ground.
std::vector<Eigen::Vector2d> with_short_sides(const std::vector<Eigen::Vector2d>& corners);

/// Appends a JSON array of the corners (m, at z = 0) in box coordinates, cut off where they pass
/// behind the camera or where its lens shows nothing, and not at the image's borders; empty when
/// nothing of the polygon would be in the image.
void append_ground_polygon(std::string& text, const std::vector<Eigen::Vector2d>& polygon,
                           const camera::Camera& camera);

}  // namespace throng::annotate
