#include "skinning/animate/motion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/error.h"
#include "base/geometry/smoothstep.h"

namespace throng::skinning {

namespace {

constexpr double kGravity = 9.81;  // m/s^2

}  // namespace

double running_speed_mps(double stature_m) { return 1.55 * std::sqrt(stature_m); }

double stride_length_m(double speed_mps, double stature_m, double age_years) {
  const double relative_speed = speed_mps / std::sqrt(kGravity * stature_m);
  const double walk = 0.42 + 1.22 * relative_speed;
  const double run = 0.30 + 1.29 * relative_speed;
  const double change = running_speed_mps(stature_m);
  const double blend = geometry::smoothstep(change - 0.25, change + 0.25, speed_mps);
  const double young = walk + blend * (run - walk);
  const double age = 1 - std::clamp(0.006 * (age_years - 60), 0.0, 0.15);
  const double shuffle = std::min(0.5 + 0.5 * speed_mps / 0.3, 1.0);
  return stature_m * young * age * shuffle;
}

PoseBlend blend_frame(const Clip& clip, double frame) {
  const auto frames = static_cast<double>(clip.frames);
  if (clip.cyclic) {
    const double at = frame - frames * std::floor(frame / frames);
    const auto before = std::min(static_cast<std::uint32_t>(at), clip.frames - 1);
    return {clip.first + before, clip.first + (before + 1) % clip.frames,
            static_cast<float>(at - before)};
  }
  const double at = std::clamp(frame, 0.0, frames - 1);
  const auto before = static_cast<std::uint32_t>(at);
  return {clip.first + before, clip.first + std::min(before + 1, clip.frames - 1),
          static_cast<float>(at - before)};
}

double sway_at(double time_s, double phase) {
  // The periods have no common multiple within hours.
  constexpr double kFastS = 4.7;
  constexpr double kSlowS = 7.9;
  const double slow = time_s / kSlowS + std::numbers::phi * phase;
  return 0.6 * std::sin(2 * std::numbers::pi * (time_s / kFastS + phase)) +
         0.4 * std::sin(2 * std::numbers::pi * slow);
}

PoseBlend standing_pose(const ClipSet& clips, double phase, double time_s) {
  const Clip& idle = clips.nearest("idle");
  const double middle = ready_frame(idle);
  // Mostly ahead, now and then far to a side.
  const double aside = std::pow(sway_at(time_s / 3, phase), 3);
  const double sway = 0.15 * sway_at(time_s, phase);
  return blend_frame(idle, middle + middle * (0.8 * aside + sway));
}

PoseBlend pose_at(const Population& population, double phase, double speed_mps, double time_s) {
  check(!population.clips.empty(), "a population has clips");
  const ClipSet clips(population);
  constexpr double kStatureM = 1.75;
  if (speed_mps < kStandingSpeed) {
    return standing_pose(clips, phase - std::floor(phase), time_s);
  }
  const bool runs = speed_mps > running_speed_mps(kStatureM);
  const Clip& clip =
      clips.nearest(runs ? "run" : "walk", stride_length_m(speed_mps, kStatureM) / kStatureM);
  return blend_frame(clip, phase * clip.frames);
}

const Clip* ClipSet::find(std::string_view name, double stride) const {
  const Clip* best = nullptr;
  double best_distance = std::numeric_limits<double>::max();
  for (const Clip& clip : *clips_) {
    const double distance = std::abs(clip.stride - stride);
    if (clip.name != name || distance >= best_distance) continue;
    best = &clip;
    best_distance = distance;
  }
  return best;
}

const Clip& ClipSet::nearest(std::string_view name, double stride) const {
  if (const Clip* clip = find(name, stride)) return *clip;
  const std::string_view kind = name.substr(0, name.find('_'));
  const bool runs = kind == "panic" || kind == "run";
  if (!runs && kind != "walk") return clips_->front();
  for (const std::string_view other :
       {kind, std::string_view(runs ? "run" : "walk"), std::string_view(runs ? "walk" : "run")}) {
    if (const Clip* clip = find(other, stride)) return *clip;
  }
  return clips_->front();
}

}  // namespace throng::skinning
