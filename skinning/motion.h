// How people move: from (who, how fast, where in the stride) to a blend of two baked palettes.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>

#include "skinning/appearance.h"
#include "skinning/population.h"

namespace throng::skinning {

/// Length of one stride (two steps) in metres at a speed: Winiarski 2019 for walking, Fukuchi 2017
/// for running, blended by smoothstep between 1.8 and 2.3 m/s.
double stride_length_m(double speed_mps, double stature_m);

/// How many strides an agent has taken at each step of its trajectory, so that feet keep step with
/// the ground: phase' = speed / stride_length(speed). `phase` and `speed_mps` have equal length.
void integrate_phase(std::span<const float> speed_mps, double dt_s, double stature_m,
                     const Appearance& appearance, std::span<double> phase);

/// The palettes to draw with: `blend` of b over a.
struct PoseBlend {
  std::uint32_t a = 0;
  std::uint32_t b = 0;
  float blend = 0;
};

/// `phase` in strides (any value), `speed_mps` >= 0, `time_s` drives the idle motion.
PoseBlend pose_at(const Population& population, double phase, double speed_mps, double time_s);

}  // namespace throng::skinning
