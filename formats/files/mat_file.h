// Writer for MATLAB's .mat files, version 5, with points and matrices.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace throng::formats {

/// The bytes of a file whose variable `image_info` is a cell with a struct of `location` (N x 2,
/// the points unchanged) and `number` (N).
std::string image_info_mat(std::span<const Eigen::Vector2d> points);

/// A matrix, row-major, with the name of its variable.
struct NamedMatrix {
  std::string_view name;
  std::size_t columns = 1;
  std::span<const double> values;
};

/// The bytes of a file with these variables.
std::string matrices_mat(const std::vector<NamedMatrix>& matrices);

}  // namespace throng::formats
