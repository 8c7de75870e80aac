#include "render/people/body_boxes.h"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace throng::render {

namespace {

using Eigen::Vector3f;

Vector3f posed(const skinning::Palette& palette, const SkinPoint& point) {
  Vector3f sum = point.weights[0] * (palette[point.bones[0]] * point.rest);
  for (std::uint32_t k = 1; k < point.bone_count; ++k) {
    sum += point.weights[k] * (palette[point.bones[k]] * point.rest);
  }
  return sum;
}

float along(std::size_t direction, const Vector3f& place) {
  return direction < 3 ? place[static_cast<Eigen::Index>(direction)]
                       : -place[static_cast<Eigen::Index>(direction - 3)];
}

/// As the shaders do, people are kept above the ground.
Eigen::AlignedBox3f above_ground(const std::array<float, 6>& far_m) {
  const Vector3f low(-far_m[3], -far_m[4], std::max(-far_m[5], kAboveGround));
  return {low, low.cwiseMax(Vector3f(far_m[0], far_m[1], far_m[2]))};
}

}  // namespace

BodyBoxes::BodyBoxes(const skinning::Population& population, std::uint32_t character,
                     std::span<const BodyShape> levels)
    : population_(&population), character_(character), levels_(levels) {}

// All six directions at once, which reach_of() needs one by one for its points.
std::array<float, 6> BodyBoxes::extent_of(const skinning::Palette& palette) const {
  std::array<Eigen::Matrix4f, skinning::kBoneCount> bones;
  for (std::size_t bone = 0; bone < bones.size(); ++bone) {
    bones[bone].setZero();
    bones[bone].topRows<3>() = palette[bone];
  }
  Eigen::Array4f low = Eigen::Array4f::Constant(std::numeric_limits<float>::infinity());
  Eigen::Array4f high = -low;
  for (const BodyShape& level : levels_) {
    for (const SkinPoint& point : level.points) {
      Eigen::Vector4f sum = point.weights[0] * (bones[point.bones[0]] * point.rest);
      for (std::uint32_t k = 1; k < point.bone_count; ++k) {
        sum += point.weights[k] * (bones[point.bones[k]] * point.rest);
      }
      low = low.min(sum.array());
      high = high.max(sum.array());
    }
  }
  return {high.x(), high.y(), high.z(), -low.x(), -low.y(), -low.z()};
}

BodyBoxes::Reach BodyBoxes::reach_of(const skinning::Palette& palette) const {
  Reach reach;
  reach.far_m.fill(-std::numeric_limits<float>::infinity());
  reach.points.fill(nullptr);
  for (const BodyShape& level : levels_) {
    for (const SkinPoint& point : level.points) {
      const Vector3f place = posed(palette, point);
      for (std::size_t i = 0; i < reach.far_m.size(); ++i) {
        if (along(i, place) <= reach.far_m[i]) continue;
        reach.far_m[i] = along(i, place);
        reach.points[i] = &point;
      }
    }
  }
  return reach;
}

const BodyBoxes::Reach& BodyBoxes::known_reach(std::uint32_t palette) {
  const auto [found, is_new] = known_.try_emplace(palette);
  if (is_new) found->second = reach_of(population_->palette(character_, palette));
  return found->second;
}

// Points of a blend lie between those of its palettes, so that it reaches no farther than the blend
// of how far these do, and as far as the farthest points of either. Between neighboring frames of a
// clip that is nearly the same; for blends of other poses every point is looked at.
Eigen::AlignedBox3f BodyBoxes::box_of(const skinning::PoseBlend& pose,
                                      const skinning::Palette& blended) {
  constexpr float kTightM = 0.001F;
  const Reach& a = known_reach(pose.a);
  if (a.points[0] == nullptr) return {};
  if (pose.blend == 0 || pose.a == pose.b) return above_ground(a.far_m);
  const Reach& b = known_reach(pose.b);
  std::array<float, 6> far_m{};
  for (std::size_t i = 0; i < far_m.size(); ++i) {
    far_m[i] = (1 - pose.blend) * a.far_m[i] + pose.blend * b.far_m[i];
    const float reached_m =
        std::max(along(i, posed(blended, *a.points[i])), along(i, posed(blended, *b.points[i])));
    if (far_m[i] - reached_m > kTightM) return above_ground(extent_of(blended));
  }
  return above_ground(far_m);
}

}  // namespace throng::render
