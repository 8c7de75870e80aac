#include "skinning/animate/spectator_pose.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/geometry/smoothstep.h"
#include "skinning/animate/sitting.h"

namespace throng::skinning {

using geometry::smoothstep;

namespace {

constexpr double kRiseS = 0.8;
constexpr double kArmsS = 0.5;
constexpr double kSettleS = 0.6;  // from sitting upright to leaning forward
constexpr double kLookS = 1;      // until somebody looks about
constexpr double kWaveS = 1.3;

/// From 0 to 1 within `ramp_s` from `from_s` after the last change on, and back before the next.
double kept(const PostureTime& posture, double from_s, double ramp_s) {
  return std::min(smoothstep((posture.since_s - from_s) / ramp_s),
                  smoothstep(posture.until_s / ramp_s));
}

/// Mostly ahead, now and then far to a side; -1 to 1.
double look(double phase, double time_s) {
  return 0.8 * std::pow(sway_at(time_s / 3, phase), 3) + 0.12 * sway_at(time_s, phase);
}

PoseBlend looking(const Clip& clip, double share, double phase, double time_s) {
  const double middle = ready_frame(clip);
  return blend_frame(clip, middle * (1 + (share > 0 ? share * look(phase, time_s) : 0)));
}

/// How a person sits, by a digit of the phase that nothing else uses: most lean forward or sit
/// upright. Estimates.
std::size_t choose_seated(double phase) {
  constexpr std::array<double, kSeatedClips.size()> kUpTo = {0.34, 0.58, 0.74, 0.88, 1};
  const double digits = 97 * phase;
  const double draw = digits - std::floor(digits);
  return static_cast<std::size_t>(std::upper_bound(kUpTo.begin(), kUpTo.end() - 1, draw) -
                                  kUpTo.begin());
}

}  // namespace

SpectatorPoses::SpectatorPoses(const Population& population)
    : clips_(population),
      rise_(clips_.find("rise")),
      cheer_(clips_.find("cheer")),
      idle_(&clips_.nearest("idle")) {
  std::transform(kSeatedClips.begin(), kSeatedClips.end(), seated_.begin(),
                 [&](std::string_view name) { return clips_.find(name); });
}

PoseBlend SpectatorPoses::seated(const PostureTime& posture, double phase, double time_s) const {
  const bool sits_down = posture.before != StandPosture::sitting;
  const double down_s = sits_down ? kRiseS : 0;
  if (posture.since_s < down_s) {
    return blend_frame(*rise_, (1 - smoothstep(posture.since_s / kRiseS)) * (rise_->frames - 1));
  }
  const double from_s = sits_down ? down_s : -10;
  const double looks = kept(posture, from_s + kSettleS, kLookS);
  const Clip* sit = seated_.front();
  const Clip* settled = seated_.at(choose_seated(phase));
  if (settled == nullptr || settled == sit) return looking(*sit, looks, phase, time_s);
  const double leans = std::min(smoothstep((posture.since_s - from_s) / kSettleS),
                                smoothstep(posture.until_s / kSettleS));
  if (leans < 1) {
    return {sit->first + ready_frame(*sit), settled->first + ready_frame(*settled),
            static_cast<float>(leans)};
  }
  const double until_s = posture.until_s - kSettleS;
  const PostureTime inner{posture.now, posture.before, posture.since_s, until_s};
  return looking(*settled, kept(inner, from_s + kSettleS, kLookS), phase, time_s);
}

PoseBlend SpectatorPoses::upright(const PostureTime& posture, double phase, double time_s) const {
  const bool gets_up = posture.before == StandPosture::sitting;
  if (gets_up && rise_ != nullptr && posture.since_s < kRiseS) {
    return blend_frame(*rise_, smoothstep(posture.since_s / kRiseS) * (rise_->frames - 1));
  }
  const double from_s = gets_up ? kRiseS : posture.before == posture.now ? -10 : 0;
  if (posture.now != StandPosture::cheering || cheer_ == nullptr) {
    return looking(*idle_, kept(posture, from_s, kLookS), phase, time_s);
  }
  const double raised = kept(posture, from_s, kArmsS);
  if (raised < 1) return blend_frame(*cheer_, raised * kCheerRaisedFrame);
  // Whole waves, between the raising of the arms and their lowering.
  const double waved_s = posture.since_s - from_s - kArmsS;
  const double left_s = posture.until_s - kArmsS;
  double wave_s = kWaveS * (0.85 + 0.3 * phase);
  if (std::isfinite(left_s)) {
    const double all_s = waved_s + left_s;
    wave_s = all_s / std::max(1.0, std::round(all_s / wave_s));
  }
  const double waves = wave_s > 0 ? waved_s / wave_s : 0;
  const double frames = cheer_->frames - 1 - kCheerRaisedFrame;
  return blend_frame(*cheer_, kCheerRaisedFrame + (waves - std::floor(waves)) * frames);
}

PoseBlend SpectatorPoses::at(const PostureTime& posture, double phase, double time_s) const {
  const bool can_sit = seated_.front() != nullptr && rise_ != nullptr;
  return posture.now == StandPosture::sitting && can_sit ? seated(posture, phase, time_s)
                                                         : upright(posture, phase, time_s);
}

Actions SpectatorPoses::actions(const PostureTime& posture, double phase) {
  if (posture.now == StandPosture::sitting) {
    const bool is_settled =
        posture.before == StandPosture::sitting || posture.since_s >= kRiseS + kSettleS;
    const bool has_phone = is_settled && posture.until_s >= kSettleS &&
                           kSeatedClips.at(choose_seated(phase)) == "sit_phone";
    return has_phone ? Actions(Action::sit, Action::use_phone) : Actions(Action::sit);
  }
  if (posture.now == StandPosture::standing) return Actions(Action::stand);
  return Actions(Action::stand, Action::cheer);
}

}  // namespace throng::skinning
