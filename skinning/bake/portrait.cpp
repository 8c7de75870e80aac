#include "skinning/bake/portrait.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/compute/srgb.h"
#include "base/geometry/angle.h"
#include "skinning/body/raster.h"

namespace throng::skinning {

namespace {

constexpr double kElevation = 20 * kDegree;  // radians
constexpr float kMarginPx = 2;               // pixels
constexpr float kUnseen = -1e9F;             // depth where nobody is seen

// Right and up in the camera's image, and toward the camera.
Eigen::Vector3f view_point(const Eigen::Vector3f& point, bool front) {
  const auto c = static_cast<float>(std::cos(kElevation));
  const auto s = static_cast<float>(std::sin(kElevation));
  const float forward = front ? point.x() : -point.x();
  return {point.y(), point.z() * c - forward * s, forward * c + point.z() * s};
}

}  // namespace

Portrait::Portrait(std::span<const PosedSurface> surfaces, int size)
    : size_(size), image_(size, size), depth_(static_cast<std::size_t>(size) * size, kUnseen) {
  Eigen::AlignedBox2f bounds;
  for (const PosedSurface& posed : surfaces) {
    for (const std::uint32_t index : posed.surface->indices) {
      for (const bool front : {true, false}) {
        bounds.extend(Eigen::Vector2f(view_point(posed.points[index], front).head<2>()));
      }
    }
  }
  low_ = bounds.min();
  extent_ = bounds.sizes();
  for (const PosedSurface& posed : surfaces) {
    draw(posed, true);
    draw(posed, false);
  }
  Mask seen(depth_.size(), 0);
  for (std::size_t at = 0; at < depth_.size(); ++at) seen[at] = depth_[at] > kUnseen ? 1 : 0;
  fill_from_nearest(image_, std::move(seen), 4);
}

void Portrait::draw(const PosedSurface& posed, bool front) {
  const auto texels = static_cast<float>(size_);
  const Surface& surface = *posed.surface;
  for (std::size_t at = 0; at < surface.indices.size(); at += 3) {
    std::array<Eigen::Vector2f, 3> corner;
    Eigen::Vector3f depth;
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3f& point = posed.points[surface.indices[at + i]];
      corner[i] = texels * uv_of(point, front);
      depth[i] = view_point(point, front).z();
    }
    for_each_pixel(corner[0], corner[1], corner[2], size_, size_,
                   [&](int x, int y, const Eigen::Vector3f& barycentric) {
                     float& nearest = depth_[static_cast<std::size_t>(y) * size_ + x];
                     const float here = depth.dot(barycentric);
                     if (here <= nearest || !is_there(posed, at, barycentric)) return;
                     nearest = here;
                     std::uint8_t* pixel = image_.pixel(x, y);
                     std::copy_n(texel_at(*posed.image, uv_within(surface, at, barycentric)), 3,
                                 pixel);
                     pixel[3] = static_cast<std::uint8_t>(surface.tint);
                   });
  }
}

Eigen::Vector2f Portrait::uv_of(const Eigen::Vector3f& point, bool front) const {
  const Eigen::Vector3f view = view_point(point, front);
  const float margin = kMarginPx / static_cast<float>(size_);
  const float across = (view.x() - low_.x()) / extent_.x();
  const float down = 1 - (view.y() - low_.y()) / extent_.y();
  return {(front ? 0 : 0.5F) + margin + across * (0.5F - 2 * margin),
          margin + down * (1 - 2 * margin)};
}

Image Portrait::colors() const {
  Image colors = image_;
  for (std::size_t at = 0; at < colors.rgba.size(); at += 4) {
    std::uint8_t* pixel = &colors.rgba[at];
    if (static_cast<Tint>(pixel[3]) != Tint::none) std::fill_n(pixel, 3, std::uint8_t{0});
    pixel[3] = 255;
  }
  return colors;
}

Image Portrait::shades() const {
  Image shades(size_, size_);
  for (std::size_t at = 0; at < shades.rgba.size(); at += 4) {
    const std::uint8_t* from = &image_.rgba[at];
    const auto tint = static_cast<Tint>(from[3]);
    if (tint == Tint::none) continue;
    const float shade =
        (linear_from_srgb(from[0]) + linear_from_srgb(from[1]) + linear_from_srgb(from[2])) / 3;
    const std::size_t channel = static_cast<std::size_t>(tint) - 1;
    const bool is_alpha = channel == 3;
    shades.rgba[at + channel] =
        is_alpha ? static_cast<std::uint8_t>(std::lround(255 * shade)) : srgb_from_linear(shade);
  }
  return shades;
}

}  // namespace throng::skinning
