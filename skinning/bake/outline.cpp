#include "skinning/bake/outline.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "skinning/body/raster.h"

namespace throng::skinning {

namespace {

constexpr float kPixelM = 0.006F;
constexpr int kMarginPixels = 4;  // pixels around everything

}  // namespace

Outline::Outline(std::span<const PosedSurface> surfaces, double yaw_rad, double elevation_rad) {
  const auto turn = Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ());
  const Eigen::Vector3d back =
      turn * Eigen::Vector3d(std::cos(elevation_rad), 0, std::sin(elevation_rad));
  const Eigen::Vector3d right = turn * Eigen::Vector3d::UnitY();
  to_image_.row(0) = right.cast<float>() / kPixelM;
  to_image_.row(1) = back.cross(right).cast<float>() / kPixelM;
  Eigen::AlignedBox2f bounds;
  for (const PosedSurface& posed : surfaces) {
    for (const std::uint32_t index : posed.surface->indices) {
      bounds.extend(Eigen::Vector2f(to_image_ * posed.points[index]));
    }
  }
  low_ = bounds.min().array() - kMarginPixels;
  width_ = static_cast<int>(std::ceil(bounds.sizes().x())) + 2 * kMarginPixels;
  height_ = static_cast<int>(std::ceil(bounds.sizes().y())) + 2 * kMarginPixels;
  Mask covered(static_cast<std::size_t>(width_) * height_, 0);
  for (const PosedSurface& posed : surfaces) draw(posed, covered);
  // Slits of a pixel or two, between a shirt and a waistband or strands of hair, are not to cut the
  // hull apart.
  measure(grown(grown(covered, 1), 0));
}

// With every pixel next to one of this value given it too.
Mask Outline::grown(const Mask& mask, std::uint8_t value) const {
  Mask result = mask;
  for (int y = 1; y + 1 < height_; ++y) {
    for (int x = 1; x + 1 < width_; ++x) {
      const std::size_t at = static_cast<std::size_t>(y) * width_ + x;
      for (const std::size_t row : {at - width_, at, at + width_}) {
        if (mask[row - 1] == value || mask[row] == value || mask[row + 1] == value) {
          result[at] = value;
        }
      }
    }
  }
  return result;
}

// Bilinear between the pixels' centers.
float Outline::distance_m(const Eigen::Vector3f& point) const {
  const Eigen::Vector2f at = (to_image_ * point - low_).array() - 0.5F;
  const auto x = static_cast<int>(std::floor(at.x()));
  const auto y = static_cast<int>(std::floor(at.y()));
  if (x < 0 || y < 0 || x + 1 >= width_ || y + 1 >= height_) return kFarM;
  const float u = at.x() - static_cast<float>(x);
  const float v = at.y() - static_cast<float>(y);
  const float* row = distance_m_.data() + static_cast<std::size_t>(y) * width_ + x;
  const float* next = row + width_;
  return (1 - v) * ((1 - u) * row[0] + u * row[1]) + v * ((1 - u) * next[0] + u * next[1]);
}

void Outline::draw(const PosedSurface& posed, Mask& covered) const {
  const std::vector<std::uint32_t>& indices = posed.surface->indices;
  std::array<Eigen::Vector2f, 3> corner;
  for (std::size_t at = 0; at < indices.size(); at += 3) {
    for (std::size_t i = 0; i < 3; ++i) {
      corner[i] = to_image_ * posed.points[indices[at + i]] - low_;
    }
    for_each_pixel(corner[0], corner[1], corner[2], width_, height_,
                   [&](int x, int y, const Eigen::Vector3f& barycentric) {
                     std::uint8_t& pixel = covered[static_cast<std::size_t>(y) * width_ + x];
                     if (pixel == 0 && is_there(posed, at, barycentric)) pixel = 1;
                   });
  }
}

// From every pixel whose mask is not `of` to the nearest where it is: the 3-4 chamfer distance
// (Borgefors 1986) in thirds of pixels.
std::vector<int> Outline::chamfer(const Mask& mask, std::uint8_t of) const {
  constexpr int kInfinite = 1 << 20;
  std::vector<int> distance(mask.size());
  for (std::size_t i = 0; i < mask.size(); ++i) distance[i] = mask[i] == of ? 0 : kInfinite;
  const auto relax = [&](int x, int y, int dx, int dy, int cost) {
    const int from_x = x + dx;
    const int from_y = y + dy;
    if (from_x < 0 || from_y < 0 || from_x >= width_ || from_y >= height_) return;
    int& here = distance[static_cast<std::size_t>(y) * width_ + x];
    here = std::min(here, distance[static_cast<std::size_t>(from_y) * width_ + from_x] + cost);
  };
  for (int y = 0; y < height_; ++y) {
    for (int x = 0; x < width_; ++x) {
      relax(x, y, -1, 0, 3);
      relax(x, y, -1, -1, 4);
      relax(x, y, 0, -1, 3);
      relax(x, y, 1, -1, 4);
    }
  }
  for (int y = height_ - 1; y >= 0; --y) {
    for (int x = width_ - 1; x >= 0; --x) {
      relax(x, y, 1, 0, 3);
      relax(x, y, 1, 1, 4);
      relax(x, y, 0, 1, 3);
      relax(x, y, -1, 1, 4);
    }
  }
  return distance;
}

void Outline::measure(const Mask& covered) {
  const std::vector<int> outside = chamfer(covered, 1);
  const std::vector<int> inside = chamfer(covered, 0);
  distance_m_.resize(covered.size());
  for (std::size_t i = 0; i < covered.size(); ++i) {
    const auto thirds = static_cast<float>(covered[i] != 0 ? -inside[i] : outside[i]);
    const float to_border = covered[i] != 0 ? 0.5F : -0.5F;  // it runs between pixels
    distance_m_[i] = std::min(kPixelM * (thirds / 3 + to_border), kFarM);
  }
}

}  // namespace throng::skinning
