// Degrees are for people: files and command lines speak them, code speaks radians.
#pragma once

#include <numbers>

namespace throng {

/// One degree in radians: 30 * kDegree.
inline constexpr double kDegree = std::numbers::pi / 180;

}  // namespace throng
