// Colors of Gazebo's material scripts, for worlds that name a material instead of a color.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string_view>

namespace throng::imports {

/// The color (RGB, 0 to 1) of a material script such as "Gazebo/Red" or "Gazebo/Wood": its diffuse
/// color, or the approximate mean of its texture. Nothing for unknown materials.
std::optional<Eigen::Vector3d> gazebo_color(std::string_view script);

}  // namespace throng::imports
