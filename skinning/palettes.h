// The palettes of a library in memory and on the device: 16 bytes per bone instead of 48.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "skinning/character.h"

namespace throng::skinning {

/// A bone's rigid motion as eight 16-bit integers, two per word, the first one in the low half: a
/// unit quaternion x, y, z, w (32767 is 1), a translation x, y, z (32767 is kMaxShiftM) and zero.
/// The vertex shader of people decodes it.
using PackedBone = std::array<std::uint32_t, 4>;

/// Max translation of a bone along each axis (m); also in the shader. The resolution is 0.24 mm.
inline constexpr float kMaxShiftM = 8;

/// A sequence of palettes, by value.
class Palettes {
 public:
  /// The bones must be rigid motions within kMaxShiftM.
  void push_back(const Palette& palette);
  void append(std::span<const Palette> palettes);
  void reserve(std::size_t palettes) { bones_.reserve(palettes * kBoneCount); }

  std::size_t size() const { return bones_.size() / kBoneCount; }
  /// To within 0.5 mm, two meters away from the bone's origin.
  Palette operator[](std::size_t index) const;
  /// All palettes, bone by bone.
  std::span<const PackedBone> bones() const { return bones_; }

 private:
  std::vector<PackedBone> bones_;
};

}  // namespace throng::skinning
