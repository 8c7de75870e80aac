// Bounding boxes of posed bodies over all levels of detail.
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

/// The boxes of one character. They contain the vertices of all levels
/// that are drawn and do not depend on cameras. The extents of palettes are cached, since people of
/// a crowd share poses. Not thread-safe.
class BodyBoxes {
 public:
  /// `levels` are the shapes of the character's drawn levels. Population and shapes must outlive
  /// this object.
  BodyBoxes(const skinning::Population& population, std::uint32_t character,
            std::span<const BodyShape> levels);

  /// The box (m, model axes) of a pose with the blended palette `blended`. It contains all
  /// vertices; each side is within a millimeter of one.
  Eigen::AlignedBox3f box_of(const skinning::PoseBlend& pose, const skinning::Palette& blended);

 private:
  /// The farthest points of a body along x, y, z, -x, -y and -z.
  struct Reach {
    std::array<float, 6> far_m;
    std::array<const SkinPoint*, 6> points;
  };

  Reach reach_of(const skinning::Palette& palette) const;
  /// How far a body reaches along x, y, z, -x, -y and -z.
  std::array<float, 6> extent_of(const skinning::Palette& palette) const;
  const Reach& known_reach(std::uint32_t palette);

  const skinning::Population* population_;
  std::uint32_t character_;
  std::span<const BodyShape> levels_;
  std::unordered_map<std::uint32_t, Reach> known_;  ///< cached extents by palette
};

}  // namespace throng::render
