// MATLAB's .mat files, version 5, as far as points and boxes need them.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace throng::formats {

/// A file whose variable `image_info` is a cell that holds a struct with `location` (N x 2) and
/// `number` (N). The points are written as they are.
std::string image_info_mat(std::span<const Eigen::Vector2d> points);

/// Numbers, row by row.
struct NamedMatrix {
  std::string_view name;
  std::size_t columns = 1;
  std::span<const double> values;
};

/// A file with these variables.
std::string matrices_mat(const std::vector<NamedMatrix>& matrices);

}  // namespace throng::formats
