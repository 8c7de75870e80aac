// Stride lengths of people, and the two palettes of the library that represent a moment of their
// motion.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "skinning/appearance.h"
#include "skinning/population.h"

namespace throng::skinning {

/// Speed (m/s) below which people stand.
inline constexpr double kStandingSpeed = 0.15;

/// Speed above which people run: at a Froude number (v^2 / (g leg), with legs of 0.53 statures) of
/// about 0.5; 2.05 m/s for 1.75 m.
double running_speed_mps(double stature_m);

/// Length (m) of one stride (two steps) at a speed: Winiarski 2019 for walking, Fukuchi 2017 for
/// running, blended around running_speed_mps() (1.8 to 2.3 m/s for adults). Shorter from an age of
/// sixty on, by up to 15 %, and below 0.3 m/s, where people shuffle.
double stride_length_m(double speed_mps, double stature_m, double age_years = 35);

/// A pose as the linear blend of two palettes, by index: a if `blend` is 0, b if it is 1.
struct PoseBlend {
  std::uint32_t a = 0;
  std::uint32_t b = 0;
  float blend = 0;
};

/// The frame of a clip at a position in frames; cyclic clips repeat in both directions.
PoseBlend blend_frame(const Clip& clip, double frame);

/// The clips of a population by name. The population must outlive this object.
class ClipSet {
 public:
  explicit ClipSet(const Population& population) : clips_(&population.clips) {}

  /// The clip with this name whose stride, in statures, is nearest; null if there is none.
  const Clip* find(std::string_view name, double stride = 0) const;
  /// As find(), with substitutes for missing clips: the plain gait for its variants, running for
  /// panic, walking for running, any clip for standing.
  const Clip& nearest(std::string_view name, double stride = 0) const;

 private:
  const std::vector<Clip>* clips_;
};

/// A clip's frame at which people stand ready: the middle of "idle" and its likes, in which they
/// look to the right before it and to the left after it.
inline std::uint32_t ready_frame(const Clip& idle) { return idle.frames / 2; }

/// How a standing person sways, from -1 to 1: smooth, and no pose comes back within minutes.
/// `phase` in [0, 1) differs between people.
double sway_at(double time_s, double phase);

/// The pose of a standing person of whom nothing but the time is known; `phase` as in sway_at().
PoseBlend standing_pose(const ClipSet& clips, double phase, double time_s);

/// The pose of a person in steady motion: `phase` in strides (any value), `speed_mps` >= 0;
/// `time_s` drives the motion of standing people. MotionPlan computes motion along a trace.
PoseBlend pose_at(const Population& population, double phase, double speed_mps, double time_s);

}  // namespace throng::skinning
