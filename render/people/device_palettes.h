// Compressed palettes on the device: 16 bytes per bone instead of 48.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "skinning/population.h"

namespace throng::render {

/// A bone's rigid motion as eight 16-bit integers, two per word, the first one in the low half: a
/// unit quaternion x, y, z, w (32767 is 1), a translation x, y, z (32767 is kMaxShiftM) and zero.
/// shaders/person.vert.glsl decodes it.
using DeviceBone = std::array<std::uint32_t, 4>;

/// Max translation of a bone along each axis (m); also in shaders/person.vert.glsl. The resolution
/// is 0.24 mm.
inline constexpr float kMaxShiftM = 8;

/// All palettes of the population, bone by bone. Throws InputError if they exceed `max_bytes` (the
/// message states how many characters fit) or if a matrix is not a rigid motion within kMaxShiftM.
std::vector<DeviceBone> device_palettes(const skinning::Population& population,
                                        std::uint64_t max_bytes);

}  // namespace throng::render
