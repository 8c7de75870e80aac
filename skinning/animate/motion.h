// How fast people's legs go, and which two baked palettes show a moment of their motion.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "skinning/appearance.h"
#include "skinning/population.h"

namespace throng::skinning {

/// After this many seconds standing repeats.
inline constexpr double kIdlePeriod = 8;
/// Below this speed, in m/s, people are taken to stand.
inline constexpr double kStandingSpeed = 0.15;

/// Above this speed people run: at a Froude number (v^2 / (g leg), legs being 0.53 statures) of
/// about 0.5; 2.05 m/s for 1.75 m.
double running_speed_mps(double stature_m);

/// Length of one stride (two steps) in meters at a speed: Winiarski 2019 for walking, Fukuchi 2017
/// for running, blended where people of that stature change (1.8 to 2.3 m/s for adults). Shorter
/// from an age of sixty on, by up to 15 %, and below 0.3 m/s, where people shuffle.
double stride_length_m(double speed_mps, double stature_m, double age_years = 35);

/// The palettes to draw with: `blend` of b over a.
struct PoseBlend {
  std::uint32_t a = 0;
  std::uint32_t b = 0;
  float blend = 0;
};

/// The frame of a clip at a position in frames; cyclic clips repeat in both directions.
PoseBlend blend_frame(const Clip& clip, double frame);

/// Somebody who moves on steadily: `phase` in strides (any value), `speed_mps` >= 0, `time_s`
/// drives the idle motion. Motion along a trace is MotionPlan's.
PoseBlend pose_at(const Population& population, double phase, double speed_mps, double time_s);

/// The clips of a population by what they show. It must outlive this.
class ClipSet {
 public:
  explicit ClipSet(const Population& population) : clips_(&population.clips) {}

  /// The clip of this name whose stride, in statures, is nearest; null when there is none.
  const Clip* find(std::string_view name, double stride = 0) const;
  /// As find, but shows something else rather than nothing: a run for a panic, a walk for a run,
  /// whatever there is for standing.
  const Clip& nearest(std::string_view name, double stride = 0) const;

 private:
  const std::vector<Clip>* clips_;
};

}  // namespace throng::skinning
