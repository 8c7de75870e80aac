#include "skinning/wardrobe/trunk_outline.h"

#include <Eigen/Geometry>

namespace throng::skinning {

namespace {

float trunk_share(const BoneWeights& weights) {
  return weights[index_from(Bone::hips)] + weights[index_from(Bone::spine)] +
         weights[index_from(Bone::chest)] + weights[index_from(Bone::neck)] +
         weights[index_from(Bone::left_clavicle)] + weights[index_from(Bone::right_clavicle)];
}

}  // namespace

TrunkOutline::TrunkOutline(const DressedPerson& person) {
  for (const Surface& surface : person.surfaces) {
    if (surface.alpha_tested || surface.painted) continue;
    for (std::size_t at = 0; at < surface.indices.size(); at += 3) {
      BoneWeights weights{};
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const BoneWeights& of_corner = surface.weights[surface.indices[at + corner]];
        for (std::size_t bone = 0; bone < kBoneCount; ++bone) weights[bone] += of_corner[bone] / 3;
      }
      if (trunk_share(weights) < 0.6F) continue;
      const Eigen::Vector3f& corner = surface.positions[surface.indices[at]];
      triangles_.push_back({corner, surface.positions[surface.indices[at + 1]] - corner,
                            surface.positions[surface.indices[at + 2]] - corner, weights});
    }
  }
}

// Moeller and Trumbore's intersection of a ray with every triangle.
std::optional<TrunkOutline::Point> TrunkOutline::outermost(const Eigen::Vector3f& origin,
                                                           const Eigen::Vector3f& direction) const {
  const Triangle* hit = nullptr;
  float furthest = 0;
  for (const Triangle& triangle : triangles_) {
    const Eigen::Vector3f p = direction.cross(triangle.to_c);
    const float determinant = triangle.to_b.dot(p);
    if (std::abs(determinant) < 1e-12F) continue;
    const Eigen::Vector3f s = origin - triangle.corner;
    const float u = s.dot(p) / determinant;
    if (u < 0 || u > 1) continue;
    const Eigen::Vector3f q = s.cross(triangle.to_b);
    const float v = direction.dot(q) / determinant;
    if (v < 0 || u + v > 1) continue;
    const float distance = triangle.to_c.dot(q) / determinant;
    if (distance <= furthest) continue;
    furthest = distance;
    hit = &triangle;
  }
  if (hit == nullptr) return std::nullopt;
  return Point{origin + furthest * direction, hit->weights};
}

}  // namespace throng::skinning
