// Boxes around posed bodies with all that any level of detail draws of them.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>

#include "render/people/person_geometry.h"
#include "skinning/animate/motion.h"
#include "skinning/population.h"

namespace throng::render {

/// The boxes of one character. They hold the vertices of every level, and are the same for every
/// camera. How far a palette's body reaches is kept, as people of a crowd share poses.
class BodyBoxes {
 public:
  /// Population and shapes must outlive it; the shapes are those of the character's levels.
  BodyBoxes(const skinning::Population& population, std::uint32_t character,
            std::span<const BodyShape> levels);

  /// The box of a pose, whose blended palette this is, in the model's axes, m: it holds all
  /// vertices, and no side is more than a millimeter away from one. Not for several threads at
  /// once.
  Eigen::AlignedBox3f box_of(const skinning::PoseBlend& pose, const skinning::Palette& blended);

 private:
  /// The farthest points of a body along x, y, z, -x, -y and -z.
  struct Reach {
    std::array<float, 6> far_m;
    std::array<const SkinPoint*, 6> points;
  };

  Reach reach_of(const skinning::Palette& palette) const;
  const Reach& known_reach(std::uint32_t palette);

  const skinning::Population* population_;
  std::uint32_t character_;
  std::span<const BodyShape> levels_;
  std::unordered_map<std::uint32_t, Reach> known_;  ///< by palette
};

}  // namespace throng::render
