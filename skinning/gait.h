// How people stand, walk and run: joint angles from published measurements, put on a character's
// own limbs so that stride length and speed agree.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "skinning/population.h"
#include "skinning/skeleton.h"

namespace throng::skinning {

/// What of a character its motion depends on.
struct Walker {
  Joints joints;
  float stature_m = 0;
  std::vector<Vertex> soles;  ///< vertices of which the lowest stands on the ground
};

/// Frames per stride, and per period of standing.
inline constexpr std::uint32_t kClipFrames = 32;
/// After this many seconds standing repeats.
inline constexpr double kIdlePeriod = 8;
/// Below this speed, in m/s, people are taken to stand.
inline constexpr double kStandingSpeed = 0.15;
/// Above this speed, in m/s, people run; walking and running strides are blended around it.
inline constexpr double kRunningSpeed = 2.05;

/// The clips that every character gets: idle, then walking and running by rising speed.
std::vector<Clip> standard_clips();

/// The palettes of one clip: `clip.frames` of them, from the left foot's strike.
std::vector<Palette> bake_clip(const Walker& walker, const Clip& clip);

/// The walker of a character: the soles are the vertices of its most detailed level that mostly
/// hang on feet and toes.
Walker walker_of(const Joints& joints, float stature_m, const Mesh& level);

}  // namespace throng::skinning
