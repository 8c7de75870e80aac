// Density map of an image: one Gaussian per head, each normalized within the image, so that the
// map's sum is the number of heads.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace throng::annotate {

/// A density map (Lempitsky and Zisserman 2010).
struct DensityMap {
  int width = 0;
  int height = 0;
  std::vector<float> value;  ///< people per pixel, row-major

  double sum() const;
};

/// The density map of heads in box coordinates (pixel i covers [i, i + 1)); heads outside of the
/// image are ignored. `sigma_px` > 0 is the kernel's width; the kernel is cut off at 4 sigma and
/// normalized within the image.
DensityMap density_map(std::span<const Eigen::Vector2d> heads, int width, int height,
                       double sigma_px);

/// The density map of heads with one kernel width each.
DensityMap density_map(std::span<const Eigen::Vector2d> heads, std::span<const double> sigmas_px,
                       int width, int height);

/// The bytes of a NumPy .npy version 1.0 file: float32, C order.
std::string npy_bytes(std::span<const int> shape, std::span<const float> values);
/// The bytes of a .npy file of a map with the shape (height, width).
std::string npy_bytes(const DensityMap& map);
/// The bytes of a compressed NumPy .npz file with one array, "density". It is much smaller than a
/// .npy file, because most pixels of a map are 0.
std::string npz_bytes(const DensityMap& map);

}  // namespace throng::annotate
