// The input of a calibration: correspondences of world points and image pixels.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "base/error.h"
#include "spec/calibration/camera_file.h"

namespace throng::calibrate {

/// The points of one image; points[i] is seen at pixels[i]. The center of the top-left pixel is
/// (0, 0), as in OpenCV.
struct View {
  std::string name;  ///< name of the image
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector2d> pixels;
};

/// The correspondences of all images.
struct Correspondences {
  ImageSize size;
  std::vector<View> views;
  std::vector<Problem> left_out;  ///< excluded images, with the reasons
};

/// Min number of points of a view.
inline constexpr std::size_t kMinPoints = 6;

/// Whether a pixel lies outside of an image by more than one pixel.
bool is_outside(const Eigen::Vector2d& pixel, const ImageSize& size);

/// Returns the first problem of a view, or an empty list: values that are not finite, too few
/// points, points or pixels that occur twice, more than a tenth of the pixels outside of the image,
/// collinear points.
std::vector<Problem> list_problems(const View& view, const ImageSize& size);

/// Moves views with problems to `left_out`. Throws InputError if a quarter of the views or more
/// have too many pixels outside of the image: then `size` is wrong, not these views.
void leave_out_bad_views(Correspondences& all);

/// Reads a table whose header names at least the columns image, X, Y, Z, u, v (in any order).
/// Images with an invalid line are excluded. Throws InputError if the file is not such a table or
/// no image is usable, and EnvironmentError if it cannot be read.
Correspondences read_correspondences(const std::filesystem::path& file, const ImageSize& size);

}  // namespace throng::calibrate
