// Palettes as they lie on the device: 16 bytes a bone instead of 48.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "skinning/population.h"

namespace throng::render {

/// A bone's rigid motion as eight 16-bit integers, two to a word, the first one lowest: a unit
/// quaternion x, y, z, w (32767 is 1), a shift x, y, z (32767 is kMaxShiftM) and zero.
/// shaders/person.vert.glsl decodes it.
using DeviceBone = std::array<std::uint32_t, 4>;

/// How far a bone's matrix may shift (m); also in shaders/person.vert.glsl. Steps are 0.24 mm.
inline constexpr float kMaxShiftM = 8;

/// Every palette of the population, bone by bone. Throws InputError when they take more than
/// `max_bytes`, telling how many people there may be, or when a matrix is no rigid motion near the
/// person.
std::vector<DeviceBone> device_palettes(const skinning::Population& population,
                                        std::uint64_t max_bytes);

}  // namespace throng::render
