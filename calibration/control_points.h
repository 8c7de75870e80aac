// Ground control points, and the pixels at which images show named points.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "calibration/correspondences.h"

namespace throng::calibrate {

/// A surveyed point of the world.
struct ControlPoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< m
  double sd_m = 0;                                     ///< of each coordinate; 0: exact
};

/// Control points by their names.
using ControlPoints = std::map<std::string, ControlPoint>;

/// Reads a table with the columns point, X, Y, Z and, optionally, sd. Throws InputError naming the
/// lines with numbers that are not finite, deviations below 0, and points that occur twice.
ControlPoints read_control_points(const std::filesystem::path& file);

/// The pixel at which an image shows a named point.
struct NamedPixel {
  std::string image;
  std::string point;
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
};

/// Reads a table with the columns point, u, v and, optionally, image (without it, all rows belong
/// to one image with the name ""). Throws InputError naming the lines with numbers that are not
/// finite and points that an image shows twice.
std::vector<NamedPixel> read_named_pixels(const std::filesystem::path& file);

}  // namespace throng::calibrate
