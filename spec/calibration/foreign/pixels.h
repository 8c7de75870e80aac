// Numbers of pixels in files of other programs.
#pragma once

#include <fmt/core.h>

#include <cmath>
#include <string>

#include "base/error.h"

namespace throng::calibrate {

/// A number of pixels, such as the width of an image. Throws InputError for what is no whole number
/// from 0 to 2^20.
inline int pixels(double value, const std::string& pointer, const std::string& source) {
  constexpr double kMaxPixels = 1 << 20;
  if (!(value >= 0 && value <= kMaxPixels) || value != std::floor(value)) {
    throw InputError(
        Problem{source, pointer, fmt::format("{}", value), "a whole number of pixels"});
  }
  return static_cast<int>(value);
}

}  // namespace throng::calibrate
