// The clips of all characters, and their computation.
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

/// The clips of every character of the library, in the order of their palettes.
std::vector<Clip> standard_clips();

/// Computes the palettes of a standard clip. A character's own motion is used in "idle", "walk",
/// starts, stops and "run".
std::vector<Palette> bake_clip(const Walker& walker, const Clip& clip, const OwnMotion& own = {});

}  // namespace throng::skinning
