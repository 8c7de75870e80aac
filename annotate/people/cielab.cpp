#include "annotate/people/cielab.h"

#include <cmath>

#include "base/compute/srgb.h"

namespace throng::annotate {

namespace {

/// CIE's cube root with a linear part near black.
float lightness_root(float share) {
  constexpr float kEpsilon = 216.0F / 24389;
  constexpr float kKappa = 24389.0F / 27;
  return share > kEpsilon ? std::cbrt(share) : (kKappa * share + 16) / 116;
}

}  // namespace

Eigen::Vector3f cielab_of_srgb(const std::uint8_t* rgb) {
  const float r = linear_from_srgb(rgb[0]);
  const float g = linear_from_srgb(rgb[1]);
  const float b = linear_from_srgb(rgb[2]);
  // IEC 61966-2-1's matrix, its rows over the white point's X, Y and Z.
  const float x = lightness_root((0.4124F * r + 0.3576F * g + 0.1805F * b) / 0.9505F);
  const float y = lightness_root(0.2126F * r + 0.7152F * g + 0.0722F * b);
  const float z = lightness_root((0.0193F * r + 0.1192F * g + 0.9505F * b) / 1.0890F);
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

}  // namespace throng::annotate
