// Directions of a camera on its gimbal as a pilot log gives them.
#pragma once

#include <vector>

#include "spec/sim/run_spec.h"

namespace throng::sim {

/// The direction at a time: linear between set-points, that of the first one before it and that of
/// the last one after it. Set-points without a direction have `otherwise`, the job's.
camera::GimbalAngles gimbal_at(const std::vector<PilotSample>& setpoints,
                               const camera::GimbalAngles& otherwise, double time_s);

/// Whether any set-point has a direction.
bool has_gimbal_setpoints(const std::vector<PilotSample>& setpoints);

/// The set-points that gimbal_at() needs for times from `from_s` to `to_s`.
std::vector<PilotSample> setpoints_around(const std::vector<PilotSample>& setpoints, double from_s,
                                          double to_s);

}  // namespace throng::sim
