// Viewing directions of the pixels of a distorted image, shared by all images of a camera.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "camera/camera.h"

namespace throng::checks {

/// Directions (x / z, y / z) of pixels. Each is computed at its first use and cached, because the
/// inverse of a distortion is iterative and the checks use most pixels several times. Use from one
/// thread at a time.
class PixelRays {
 public:
  explicit PixelRays(const camera::Intrinsics& intrinsics);

  /// Whether these are the rays for the intrinsics `other`.
  bool are_of(const camera::Intrinsics& other) const;
  /// intrinsics.direction_of({x, y}); NaN outside the distortion's range.
  Eigen::Vector2d direction(int x, int y) const;

 private:
  camera::Intrinsics intrinsics_;
  mutable std::vector<Eigen::Vector2d> directions_;  // row by row; kUnknown until computed
};

}  // namespace throng::checks
