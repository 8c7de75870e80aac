// Directions of the pixels of a distorted image, computed once for all images of a camera.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "camera/camera.h"

namespace throng::formats {

/// The directions (x / z, y / z) of pixels, each computed when it is first asked for: the inverse
/// of a distortion is an iteration, and the checks look at most pixels several times. Not for
/// several threads at once.
class PixelRays {
 public:
  explicit PixelRays(const camera::Intrinsics& intrinsics);

  /// Whether these are the rays of such a camera.
  bool are_of(const camera::Intrinsics& other) const;
  /// intrinsics.direction_of({x, y}); NaN outside the distortion's range.
  Eigen::Vector2d direction(int x, int y) const;

 private:
  camera::Intrinsics intrinsics_;
  mutable std::vector<Eigen::Vector2d> directions_;  // row by row; kUnknown until asked for
};

}  // namespace throng::formats
