#include "base/compute/srgb.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace throng {

namespace {

constexpr int kLevels = 256;
/// Fine enough that the table's bytes are those of the formula but for ties: sRGB is steepest at
/// black, 12.92 * 255 bytes per unit of light.
constexpr int kSteps = 1 << 16;

double encoded(double light) {
  return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
}

const std::array<float, kLevels>& decoding() {
  static const std::array<float, kLevels> table = [] {
    std::array<float, kLevels> made{};
    for (std::size_t i = 0; i < made.size(); ++i) {
      made[i] = static_cast<float>(linear_from_encoded(static_cast<double>(i) / (kLevels - 1)));
    }
    return made;
  }();
  return table;
}

const std::array<std::uint8_t, kSteps + 1>& encoding() {
  static const std::array<std::uint8_t, kSteps + 1> table = [] {
    std::array<std::uint8_t, kSteps + 1> made{};
    for (std::size_t i = 0; i < made.size(); ++i) {
      made[i] = static_cast<std::uint8_t>(
          std::lround(encoded(static_cast<double>(i) / kSteps) * (kLevels - 1)));
    }
    return made;
  }();
  return table;
}

}  // namespace

double linear_from_encoded(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

float linear_from_srgb(std::uint8_t byte) { return decoding()[byte]; }

std::uint8_t srgb_from_linear(float light) {
  const float clipped = light > 0 ? std::min(light, 1.0F) : 0;  // in this order for NaN
  return encoding()[static_cast<std::size_t>(std::lrint(clipped * kSteps))];
}

}  // namespace throng
