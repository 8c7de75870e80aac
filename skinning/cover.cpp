#include "skinning/cover.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "skinning/portrait.h"

namespace throng::skinning {

Clothing::Limb Clothing::limb_of(const BoneWeights& weights) {
  const auto strongest =
      static_cast<Bone>(std::max_element(weights.begin(), weights.end()) - weights.begin());
  if (strongest >= Bone::right_thigh) return Limb::right_leg;
  if (strongest >= Bone::left_thigh) return Limb::left_leg;
  if (strongest >= Bone::right_upper_arm) return Limb::right_arm;
  if (strongest == Bone::right_clavicle) return Limb::trunk;
  if (strongest >= Bone::left_upper_arm) return Limb::left_arm;
  return Limb::trunk;
}

Clothing::Clothing(const DressedPerson& person, const std::map<std::string, Image>& textures) {
  for (std::size_t i = 1; i < person.surfaces.size(); ++i) {
    const Surface& surface = person.surfaces[i];
    if (surface.painted) continue;
    const Image& image = textures.at(surface.texture);
    for (std::size_t at = 0; at < surface.indices.size(); at += 3) {
      const std::uint32_t first = surface.indices[at];
      if (surface.alpha_tested) {
        const Eigen::Vector2f uv = uv_within(surface, at, Eigen::Vector3f::Constant(1 / 3.0F));
        if (texel_at(image, uv)[3] < 128) continue;
      }
      const Eigen::Vector3f& corner = surface.fitted[first];
      triangles_.push_back({corner, surface.fitted[surface.indices[at + 1]] - corner,
                            surface.fitted[surface.indices[at + 2]] - corner,
                            limb_of(surface.weights[first]), surface.tint, surface.alpha_tested});
    }
  }
}

// Moeller and Trumbore's intersection of a ray with every triangle.
Cover Clothing::over(const Eigen::Vector3f& point, const Eigen::Vector3f& normal,
                     const BoneWeights& weights) const {
  constexpr float kBelow_m = 0.02F;  // garments may dip below the skin
  constexpr float kParallel = 1e-12F;
  const Limb limb = limb_of(weights);
  const float reach_m = limb == Limb::trunk ? 0.12F : 0.07F;
  const Eigen::Vector3f origin = point - kBelow_m * normal;
  Cover outermost;
  float furthest = -kBelow_m;
  for (const Triangle& triangle : triangles_) {
    const bool may_cover =
        triangle.limb == limb || triangle.limb == Limb::trunk || limb == Limb::trunk;
    if (!may_cover) continue;
    const Eigen::Vector3f p = normal.cross(triangle.to_c);
    const float determinant = triangle.to_b.dot(p);  // negative when it faces outwards
    const bool crosses =
        triangle.two_sided ? std::abs(determinant) > kParallel : determinant < -kParallel;
    if (!crosses) continue;
    const Eigen::Vector3f s = origin - triangle.corner;
    const float u = s.dot(p) / determinant;
    if (u < 0 || u > 1) continue;
    const Eigen::Vector3f q = s.cross(triangle.to_b);
    const float v = normal.dot(q) / determinant;
    if (v < 0 || u + v > 1) continue;
    const float distance = triangle.to_c.dot(q) / determinant - kBelow_m;
    if (distance < furthest || distance > reach_m) continue;
    furthest = distance;
    outermost = {distance, triangle.tint};
  }
  return outermost;
}

}  // namespace throng::skinning
