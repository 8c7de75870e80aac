// Colors of Gazebo's own materials, for worlds that name them instead of a color.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string_view>

namespace throng::imports {

/// The color (RGB, 0 to 1) of a material script as "Gazebo/Red" or "Gazebo/Wood": that of its
/// paint, or about the mean of its texture. Nothing for materials that are not Gazebo's.
std::optional<Eigen::Vector3d> gazebo_color(std::string_view script);

}  // namespace throng::imports
