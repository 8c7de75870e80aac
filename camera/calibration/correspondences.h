// Input of a calibration: correspondences of world points and image pixels.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "base/error.h"
#include "spec/calibration/camera_file.h"

namespace throng::calibrate {

/// One image's points. Pixels as OpenCV counts them: the middle of the top-left one is (0, 0).
struct View {
  std::string name;  ///< of the image
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector2d> pixels;
};

struct Correspondences {
  ImageSize size;
  std::vector<View> views;
  std::vector<Problem> left_out;  ///< images that cannot be used, and why
};

/// Fewest points of a view that fix its pose beside the lens.
inline constexpr std::size_t kMinPoints = 6;

/// Whether a pixel lies outside of an image's border by more than a pixel.
bool is_outside(const Eigen::Vector2d& pixel, const ImageSize& size);

/// Errors of a view: too few points, more than a tenth of them outside the image, values that are
/// not finite, points or pixels that occur twice, points in a line. Empty: nothing.
std::vector<Problem> list_problems(const View& view, const ImageSize& size);

/// Moves views that have problems to `left_out`. Throws InputError when a quarter of the views or
/// more are of another image size: the size is wrong then, not these views.
void leave_out_bad_views(Correspondences& all);

/// Reads a table with a header that names at least the columns image, X, Y, Z, u, v (any order).
/// Images with a bad line are left out. Throws InputError when the file is not such a table, or no
/// image of it can be used, and EnvironmentError when it cannot be read.
Correspondences read_correspondences(const std::filesystem::path& file, const ImageSize& size);

}  // namespace throng::calibrate
