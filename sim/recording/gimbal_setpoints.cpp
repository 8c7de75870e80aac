#include "sim/recording/gimbal_setpoints.h"

#include <algorithm>
#include <cmath>

namespace throng::sim {

namespace {

/// The first set-point after a time.
auto first_after(const std::vector<PilotSample>& setpoints, double time_s) {
  return std::upper_bound(setpoints.begin(), setpoints.end(), time_s,
                          [](double t, const PilotSample& sample) { return t < sample.time_s; });
}

}  // namespace

camera::GimbalAngles gimbal_at(const std::vector<PilotSample>& setpoints,
                               const camera::GimbalAngles& otherwise, double time_s) {
  if (setpoints.empty()) return otherwise;
  const auto after = first_after(setpoints, time_s);
  if (after == setpoints.begin()) return after->gimbal.value_or(otherwise);
  const PilotSample& before = *(after - 1);
  const camera::GimbalAngles from = before.gimbal.value_or(otherwise);
  if (after == setpoints.end()) return from;
  const camera::GimbalAngles to = after->gimbal.value_or(otherwise);
  const double share = (time_s - before.time_s) / (after->time_s - before.time_s);
  return {std::lerp(from.pitch_deg, to.pitch_deg, share),
          std::lerp(from.yaw_deg, to.yaw_deg, share)};
}

bool has_gimbal_setpoints(const std::vector<PilotSample>& setpoints) {
  return std::any_of(setpoints.begin(), setpoints.end(),
                     [](const PilotSample& sample) { return sample.gimbal.has_value(); });
}

std::vector<PilotSample> setpoints_around(const std::vector<PilotSample>& setpoints, double from_s,
                                          double to_s) {
  auto first = first_after(setpoints, from_s);
  auto end = first_after(setpoints, to_s);
  if (first != setpoints.begin()) --first;
  if (end != setpoints.end()) ++end;
  return {first, end};
}

}  // namespace throng::sim
