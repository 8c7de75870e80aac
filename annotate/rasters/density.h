// Crowd density in the image: a Gaussian per head, each normalized inside the image, so that the
// map's sum is the count exactly.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace throng::annotate {

struct DensityMap {
  int width = 0;
  int height = 0;
  std::vector<float> value;  ///< people per pixel, row-major

  double sum() const;
};

/// Heads in box coordinates (pixel i covers [i, i + 1)); heads outside the image do not count.
/// `sigma_px` > 0; the kernel is cut off at 4 sigma and renormalized at the borders.
DensityMap density_map(std::span<const Eigen::Vector2d> heads, int width, int height,
                       double sigma_px);

/// The same with a width of its own for each head.
DensityMap density_map(std::span<const Eigen::Vector2d> heads, std::span<const double> sigmas_px,
                       int width, int height);

/// The bytes of a NumPy .npy version 1.0 file: float32, C order.
std::string npy_bytes(std::span<const int> shape, std::span<const float> values);
/// That of a map, shape (height, width).
std::string npy_bytes(const DensityMap& map);
/// A compressed NumPy .npz file of one array, "density": a small part of npy_bytes(), since most
/// pixels of a map are 0.
std::string npz_bytes(const DensityMap& map);

}  // namespace throng::annotate
