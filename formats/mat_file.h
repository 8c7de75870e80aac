// MATLAB's .mat files, version 5, as far as ShanghaiTech's points need them.
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>

namespace throng::formats {

/// A file whose variable `image_info` is a cell that holds a struct with `location` (N x 2) and
/// `number` (N). The points are written as they are.
std::string image_info_mat(std::span<const Eigen::Vector2d> points);

}  // namespace throng::formats
