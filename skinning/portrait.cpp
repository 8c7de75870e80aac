#include "skinning/portrait.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "skinning/raster.h"

namespace throng::skinning {

namespace {

constexpr double kElevation = 20 * std::numbers::pi / 180;  // radians
constexpr float kMargin = 2;                                // pixels

// Right and up in the camera's picture, and towards the camera.
Eigen::Vector3f view_of(const Eigen::Vector3f& point, bool front) {
  const auto c = static_cast<float>(std::cos(kElevation));
  const auto s = static_cast<float>(std::sin(kElevation));
  const float forward = front ? point.x() : -point.x();
  return {point.y(), point.z() * c - forward * s, forward * c + point.z() * s};
}

}  // namespace

const std::uint8_t* texel_at(const Image& image, const Eigen::Vector2f& uv) {
  const auto at = [](float value, int count) {
    return std::clamp(static_cast<int>(std::floor(value * static_cast<float>(count))), 0,
                      count - 1);
  };
  return image.pixel(at(uv.x(), image.width), at(uv.y(), image.height));
}

Eigen::Vector2f uv_within(const Surface& surface, std::size_t at,
                          const Eigen::Vector3f& barycentric) {
  return barycentric.x() * surface.uvs[surface.indices[at]] +
         barycentric.y() * surface.uvs[surface.indices[at + 1]] +
         barycentric.z() * surface.uvs[surface.indices[at + 2]];
}

Portrait::Portrait(const DressedPerson& person, const std::map<std::string, Image>& textures,
                   int size)
    : size_(size), colours_(size, size), texels_(static_cast<std::size_t>(size) * size) {
  Eigen::AlignedBox2f bounds;
  for (const Surface& surface : person.surfaces) {
    for (const std::uint32_t index : surface.indices) {
      for (const bool front : {true, false}) {
        bounds.extend(Eigen::Vector2f(view_of(surface.fitted[index], front).head<2>()));
      }
    }
  }
  low_ = bounds.min();
  extent_ = bounds.sizes();
  for (const Surface& surface : person.surfaces) {
    draw(surface, textures.at(surface.texture), true);
    draw(surface, textures.at(surface.texture), false);
  }
}

void Portrait::draw(const Surface& surface, const Image& image, bool front) {
  const auto texels = static_cast<float>(size_);
  for (std::size_t at = 0; at < surface.indices.size(); at += 3) {
    std::array<Eigen::Vector2f, 3> corner;
    Eigen::Vector3f depth;
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3f& point = surface.fitted[surface.indices[at + i]];
      corner[i] = texels * uv_of(point, front);
      depth[i] = view_of(point, front).z();
    }
    for_each_pixel(corner[0], corner[1], corner[2], size_, size_,
                   [&](int x, int y, const Eigen::Vector3f& barycentric) {
                     Texel& texel = texels_[static_cast<std::size_t>(y) * size_ + x];
                     const float here = depth.dot(barycentric);
                     if (here <= texel.depth) return;
                     const std::uint8_t* from =
                         texel_at(image, uv_within(surface, at, barycentric));
                     if (surface.alpha_tested && from[3] < 128) return;
                     texel = {here, true, surface.tint != Tint::none};
                     std::copy_n(from, 3, colours_.pixel(x, y));
                   });
  }
}

Eigen::Vector2f Portrait::uv_of(const Eigen::Vector3f& point, bool front) const {
  const Eigen::Vector3f view = view_of(point, front);
  const float margin = kMargin / static_cast<float>(size_);
  const float across = (view.x() - low_.x()) / extent_.x();
  const float down = 1 - (view.y() - low_.y()) / extent_.y();
  return {(front ? 0 : 0.5F) + margin + across * (0.5F - 2 * margin),
          margin + down * (1 - 2 * margin)};
}

Image Portrait::picture(bool tinted) const {
  Image picture = colours_;
  Mask seen(texels_.size(), 0);
  for (std::size_t at = 0; at < texels_.size(); ++at) {
    seen[at] = texels_[at].seen && texels_[at].tinted == tinted ? 1 : 0;
    picture.rgba[4 * at + 3] = 255;
  }
  fill_from_nearest(picture, std::move(seen));
  return picture;
}

}  // namespace throng::skinning
