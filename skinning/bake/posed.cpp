#include "skinning/bake/posed.h"

#include <algorithm>
#include <cmath>

namespace throng::skinning {

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

bool is_there(const PosedSurface& posed, std::size_t at, const Eigen::Vector3f& barycentric) {
  if (!posed.surface->alpha_tested) return true;
  return texel_at(*posed.image, uv_within(*posed.surface, at, barycentric))[3] >= 128;
}

}  // namespace throng::skinning
