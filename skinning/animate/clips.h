// The clips that every character gets, and baking them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "skinning/animate/figure.h"
#include "skinning/animate/own_motion.h"
#include "skinning/population.h"

namespace throng::skinning {

/// Frames per stride.
inline constexpr std::uint32_t kClipFrames = 20;

/// The clips of every baked character, one behind the other.
std::vector<Clip> standard_clips();

/// The palettes of one of the standard clips. A character's own motion is used in "idle", "walk",
/// starts, stops and "run".
std::vector<Palette> bake_clip(const Walker& walker, const Clip& clip, const OwnMotion& own = {});

}  // namespace throng::skinning
