#include "skinning/motion.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "base/error.h"
#include "skinning/gait.h"

namespace throng::skinning {

namespace {

constexpr double kGravity = 9.81;  // m/s^2

const Clip& clip_at(const Population& population, double speed_mps) {
  const Clip* best = &population.clips.front();
  double best_distance = std::numeric_limits<double>::max();
  const bool stands = speed_mps < kStandingSpeed;
  const bool runs = speed_mps >= kRunningSpeed;
  for (const Clip& clip : population.clips) {
    const bool fits = stands ? clip.name == "idle" : clip.name == (runs ? "run" : "walk");
    const double distance = std::abs(clip.speed_mps - speed_mps);
    if (fits && distance < best_distance) {
      best = &clip;
      best_distance = distance;
    }
  }
  return *best;
}

}  // namespace

double stride_length_m(double speed_mps, double stature_m) {
  const double relative_speed = speed_mps / std::sqrt(kGravity * stature_m);
  const double walk = 0.42 + 1.22 * relative_speed;
  const double run = 0.30 + 1.29 * relative_speed;
  const double t = std::clamp((speed_mps - 1.8) / (2.3 - 1.8), 0.0, 1.0);
  const double blend = t * t * (3 - 2 * t);
  return stature_m * (walk + blend * (run - walk));
}

void integrate_phase(std::span<const float> speed_mps, double dt_s, double stature_m,
                     const Appearance& appearance, std::span<double> phase) {
  check(speed_mps.size() == phase.size(), "a phase for each speed");
  const auto rate_hz = [&](float speed) {
    return appearance.cadence * speed / stride_length_m(speed, stature_m);
  };
  double strides = appearance.phase_offset;
  for (std::size_t step = 0; step < phase.size(); ++step) {
    if (step > 0) {
      strides += 0.5 * dt_s * (rate_hz(speed_mps[step - 1]) + rate_hz(speed_mps[step]));
    }
    phase[step] = strides;
  }
}

PoseBlend pose_at(const Population& population, double phase, double speed_mps, double time_s) {
  check(!population.clips.empty(), "a population has clips");
  const Clip& clip = clip_at(population, speed_mps);
  const bool stands = clip.name == "idle";
  const double turns = stands ? phase + time_s / kIdlePeriod : phase;
  const double at = (turns - std::floor(turns)) * clip.frames;
  const auto frame = std::min(static_cast<std::uint32_t>(at), clip.frames - 1);
  return {clip.first + frame, clip.first + (frame + 1) % clip.frames,
          static_cast<float>(at - frame)};
}

}  // namespace throng::skinning
