// Clothes as surfaces, and how one lies over another.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include "skinning/body/surface.h"
#include "skinning/wardrobe/dress.h"
#include "skinning/wardrobe/wardrobe.h"

namespace throng::skinning {

/// How far (m) jackets and coats lie over what would be worn below them.
inline constexpr float kOuterwearM = 0.008F;

/// The share of a vertex's motion that is the trunk's.
float trunk_weight(const BoneWeights& weights);

/// Heights at which surfaces end on the trunk, in sectors all around it.
class Rim {
 public:
  enum class End : std::uint8_t { lower, upper };
  static constexpr std::size_t kSectors = 16;

  Rim(std::span<const Surface> surfaces, const Joints& joints, End end) {
    const float none = end == End::lower ? std::numeric_limits<float>::max()
                                         : std::numeric_limits<float>::lowest();
    height_m_.fill(none);
    const Eigen::Vector3f& hips = joints[0];
    for (const Surface& surface : surfaces) {
      for (const std::uint32_t index : surface.indices) {
        const BoneWeights& weights = surface.weights[index];
        if (trunk_weight(weights) < (end == End::lower ? 0.6F : 0.1F)) continue;
        const Eigen::Vector3f& p = surface.positions[index];
        float& here = height_m_[sector_of(p - hips)];
        here = end == End::lower ? std::min(here, p.z()) : std::max(here, p.z());
      }
    }
  }

  float operator[](std::size_t sector) const { return height_m_[sector]; }
  /// The highest around a direction.
  float highest(const Eigen::Vector3f& from_hips) const {
    const std::size_t here = sector_of(from_hips);
    return std::max({height_m_[(here + kSectors - 1) % kSectors], height_m_[here],
                     height_m_[(here + 1) % kSectors]});
  }
  static std::size_t sector_of(const Eigen::Vector3f& from_hips) {
    const double turn = std::atan2(from_hips.y(), from_hips.x()) / (2 * std::numbers::pi) + 0.5;
    return std::min(static_cast<std::size_t>(turn * kSectors), kSectors - 1);
  }

 private:
  std::array<float, kSectors> height_m_{};
};

/// A garment's piece on a body.
Surface wear(const Garment& garment, const DressedPerson& dressed);
std::vector<Surface> wear_all(const Worn& worn, const DressedPerson& dressed);

/// Pushes a vertex inward along its normal.
void tuck_in(Surface& surface, std::size_t i, float tuck_m, const Palette& to_neutral);

/// Moves all surfaces outward: thick cloth lies further out, over what is worn below it.
void thicken(std::vector<Surface>& surfaces, float by_m, const Palette& to_neutral);

/// Whether a condition holds for all corners of the triangle at a position of the indices.
bool all_corners(const Surface& surface, std::size_t at, const auto& holds) {
  return holds(surface.indices[at]) && holds(surface.indices[at + 1]) &&
         holds(surface.indices[at + 2]);
}

/// Removes what lies below a height in the A-pose.
void cut_below(std::vector<Surface>& surfaces, float height_m);

/// Removes what lies above a height of the neutral stance: neither does a shoe show through
/// trousers nor hair through a hat.
void hide_above(std::vector<Surface>& surfaces, float height_m);

/// Lets a bottom lie under a top: a waistband must not show through a shirt worn over it. Parts
/// that the shirt covers are rendered further in, and those that it covers well not at all. Hems
/// are uneven, so that depends on the direction.
void tuck_under(std::vector<Surface>& bottoms, const Rim& hem, const DressedPerson& dressed);

/// Lets hair end at the rim of a hat without a brim.
void hide_under(std::vector<Surface>& hair, const std::vector<Surface>& hat);

/// Adds the tail of a coat down to a hem (m, in the A-pose) to the bottoms, and removes what it
/// covers of these.
void add_tail(const Worn& tail, float hem_m, const Rim& top, const DressedPerson& dressed,
              std::vector<Surface>& bottoms);

}  // namespace throng::skinning
