// Ground control points, and the pixels at which images show points that have names.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "camera/calibration/correspondences.h"

namespace throng::calibrate {

/// A surveyed point of the world.
struct ControlPoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< m
  double sd_m = 0;                                     ///< of each coordinate; 0: taken as exact
};

/// By name.
using ControlPoints = std::map<std::string, ControlPoint>;

/// Reads the columns point, X, Y, Z and, if there, sd. Throws InputError naming the lines with
/// numbers that are not finite, deviations below 0, and points that occur twice.
ControlPoints read_control_points(const std::filesystem::path& file);

struct NamedPixel {
  std::string image;
  std::string point;
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
};

/// Reads the columns point, u, v and, if there, image (without it, all are of one image, "").
/// Throws InputError as above, also for a point that an image shows twice.
std::vector<NamedPixel> read_named_pixels(const std::filesystem::path& file);

}  // namespace throng::calibrate
