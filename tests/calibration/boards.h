// Synthetic views of boards through a known lens, shared by the tests.
#pragma once

#include <cmath>
#include <string>

#include "base/compute/random.h"
#include "calibration/adjustment.h"
#include "calibration/correspondences.h"
#include "calibration/projection.h"

namespace throng::calibrate {

struct SyntheticCamera {
  Lens lens = Lens::brown5;
  Parameters parameters{1200, 1200, 959.5, 539.5, 0, -0.12, 0.06, 0.0005, -0.0003, -0.01};
  ImageSize size{1920, 1080};

  Eigen::Vector2d pixel_of(const ViewPose& pose, const Eigen::Vector3d& point) const {
    const Eigen::Vector3d seen = pose.to_camera(point);
    Eigen::Vector2d pixel;
    if (!project(lens == Lens::fisheye, parameters.data(), seen.data(), pixel.data())) {
      return Eigen::Vector2d::Constant(-1e9);
    }
    return pixel;
  }
  bool shows(const Eigen::Vector2d& pixel) const {
    return pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() < size.width && pixel.y() < size.height;
  }
};

/// Corners of a 9 x 7 board of 30 mm, around its middle.
inline std::vector<Eigen::Vector3d> board_corners() {
  constexpr double kSquare = 0.03;
  std::vector<Eigen::Vector3d> corners;
  for (int row = 0; row < 7; ++row) {
    for (int column = 0; column < 9; ++column) {
      corners.emplace_back(kSquare * (column - 4), kSquare * (row - 3), 0);
    }
  }
  return corners;
}

struct SyntheticViews {
  Correspondences all;
  std::vector<ViewPose> poses;
};

/// Boards anywhere in the image, tilted by up to `tilt_rad` about x and y and turned about z, all
/// of their corners in it, with normal noise on each pixel coordinate.
inline SyntheticViews synthetic_views(const SyntheticCamera& camera, int views, double sigma_px,
                                      std::uint64_t seed, double tilt_rad = 0.7) {
  SyntheticViews result;
  result.all.size = camera.size;
  for (std::uint64_t attempt = 0; static_cast<int>(result.poses.size()) < views; ++attempt) {
    Random random(seed, Stream::bootstrap, attempt);
    const Eigen::Matrix3d turn =
        (Eigen::AngleAxisd(random.uniform(-tilt_rad, tilt_rad), Eigen::Vector3d::UnitX()) *
         Eigen::AngleAxisd(random.uniform(-tilt_rad, tilt_rad), Eigen::Vector3d::UnitY()) *
         Eigen::AngleAxisd(random.uniform(-3, 3), Eigen::Vector3d::UnitZ()))
            .toRotationMatrix();
    const double z = random.uniform(0.25, 0.6);
    const Eigen::Vector3d at(z * random.uniform(-0.8, 0.8), z * random.uniform(-0.45, 0.45), z);
    const ViewPose pose = to_view_pose({turn, at});
    View view{"view" + std::to_string(result.poses.size()), {}, {}};
    bool whole = true;
    for (const Eigen::Vector3d& corner : board_corners()) {
      const Eigen::Vector2d pixel = camera.pixel_of(pose, corner);
      whole = whole && camera.shows(pixel);
      view.points.push_back(corner);
      view.pixels.emplace_back(pixel.x() + random.normal(0, sigma_px),
                               pixel.y() + random.normal(0, sigma_px));
    }
    if (!whole) continue;
    result.all.views.push_back(std::move(view));
    result.poses.push_back(pose);
  }
  return result;
}

/// Moves this share of the points by `offset_px` in a random direction.
inline void add_outliers(Correspondences& all, double share, double offset_px, std::uint64_t seed) {
  Random random(seed, Stream::bootstrap, 1'000'000);
  for (View& view : all.views) {
    for (Eigen::Vector2d& pixel : view.pixels) {
      const double direction = random.uniform(0, 6.283185307179586);
      if (random.uniform() >= share) continue;
      pixel += offset_px * Eigen::Vector2d(std::cos(direction), std::sin(direction));
    }
  }
}

}  // namespace throng::calibrate
