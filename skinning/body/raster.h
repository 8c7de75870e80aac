// Rasterization of a triangle.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "base/geometry/polygon.h"

namespace throng::skinning {

/// Calls visit(x, y, barycentric) for every pixel of a width x height image whose center lies in
/// the triangle (either winding), row by row. Corners are in pixels; pixel i covers [i, i + 1).
template <typename Visit>
void for_each_pixel(const Eigen::Vector2f& a, const Eigen::Vector2f& b, const Eigen::Vector2f& c,
                    int width, int height, const Visit& visit) {
  const Eigen::Vector2f ab = b - a;
  const Eigen::Vector2f ac = c - a;
  const float area = geometry::cross(ab, ac);
  if (!(std::abs(area) > 1e-12F)) return;
  const Eigen::Vector2f low = a.cwiseMin(b).cwiseMin(c);
  const Eigen::Vector2f high = a.cwiseMax(b).cwiseMax(c);
  const auto limit = [](float value, int last) {
    return static_cast<int>(std::clamp(value, 0.0F, static_cast<float>(last)));
  };
  const int left = limit(std::floor(low.x()), width);
  const int right = limit(std::ceil(high.x()), width);
  const int top = limit(std::floor(low.y()), height);
  const int bottom = limit(std::ceil(high.y()), height);
  for (int y = top; y < bottom; ++y) {
    for (int x = left; x < right; ++x) {
      const Eigen::Vector2f p =
          Eigen::Vector2f(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F) - a;
      const float of_b = geometry::cross(p, ac) / area;
      const float of_c = geometry::cross(ab, p) / area;
      if (of_b < 0 || of_c < 0 || of_b + of_c > 1) continue;
      visit(x, y, Eigen::Vector3f(1 - of_b - of_c, of_b, of_c));
    }
  }
}

}  // namespace throng::skinning
