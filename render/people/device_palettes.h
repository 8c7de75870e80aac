// The limit of graphics devices on people's motion.
#pragma once

#include <cstdint>
#include <span>

#include "skinning/population.h"

namespace throng::render {

/// All palettes of the population, bone by bone, as the device takes them. Throws InputError if
/// they exceed `max_bytes` (the message states how many characters fit).
std::span<const skinning::PackedBone> device_palettes(const skinning::Population& population,
                                                      std::uint64_t max_bytes);

}  // namespace throng::render
