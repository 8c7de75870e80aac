// Pilot logs: a drone's set-points as CSV, which can be edited and replayed.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "spec/sim/run_spec.h"

namespace throng::sim {

/// The header of every log: seconds, meters, degrees counter-clockwise from +x, and 1 while people
/// can follow the drone.
inline constexpr std::string_view kPilotLogHeader = "time_s,x_m,y_m,z_m,yaw_deg,beacon";
/// Further columns of logs that turn the camera: degrees above the horizon and to the left of the
/// heading; both empty where the camera points as the job says.
inline constexpr std::string_view kGimbalLogHeader = ",gimbal_pitch_deg,gimbal_yaw_deg";

std::string pilot_log_csv(const std::vector<PilotSample>& samples);

/// Parses a log; the inverse of pilot_log_csv(). Throws InputError naming `source` and the line,
/// also for times that do not increase.
std::vector<PilotSample> parse_pilot_log(std::string_view csv, const std::string& source);

}  // namespace throng::sim
