#include "checks/pixel_rays.h"

#include <limits>
#include <tuple>

namespace throng::checks {

namespace {

constexpr double kUnknown = std::numeric_limits<double>::infinity();

}  // namespace

PixelRays::PixelRays(const camera::Intrinsics& intrinsics)
    : intrinsics_(intrinsics),
      directions_(
          static_cast<std::size_t>(intrinsics.width) * static_cast<std::size_t>(intrinsics.height),
          Eigen::Vector2d::Constant(kUnknown)) {}

bool PixelRays::are_of(const camera::Intrinsics& other) const {
  const auto sizes_and_lens = [](const camera::Intrinsics& of) {
    return std::tuple(of.width, of.height, of.fx_px, of.fy_px, of.cx_px, of.cy_px, of.skew_px,
                      of.distortion.has_value());
  };
  if (sizes_and_lens(other) != sizes_and_lens(intrinsics_)) return false;
  return !other.distortion ||
         (other.distortion->model() == intrinsics_.distortion->model() &&
          other.distortion->coefficients() == intrinsics_.distortion->coefficients());
}

Eigen::Vector2d PixelRays::direction(int x, int y) const {
  const auto pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(intrinsics_.width) +
                     static_cast<std::size_t>(x);
  Eigen::Vector2d& direction = directions_[pixel];
  if (direction.x() == kUnknown) {
    direction = intrinsics_.direction_of({x, y}).value_or(
        Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN()));
  }
  return direction;
}

}  // namespace throng::checks
