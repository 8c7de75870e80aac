// Commands of a live flight as JSON.
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"

namespace throng::live {

/// Max duration of a flight in simulated seconds, so that the job with its recorded set-points
/// stays small enough to be submitted.
inline constexpr double kMaxFlightS = 600;

/// A drone that can be commanded.
struct FlownDrone {
  std::string id;
  bool has_gimbal = true;  ///< its camera is not rigid
};

/// Commands for one drone; absent members change nothing.
struct DroneCommand {
  std::string id;
  /// Forward, left, up in the drone's heading frame.
  std::optional<std::array<double, 3>> velocity_mps;
  std::optional<double> yaw_rate_deg_s;  ///< counter-clockwise
  /// Point to fly to in the world, after the waypoints if both are given.
  std::optional<std::array<double, 3>> position_m;
  /// Points to fly to one after another; none: the drone stops.
  std::optional<std::vector<std::array<double, 3>>> waypoints_m;
  std::optional<double> yaw_deg;    ///< heading to turn to, counter-clockwise from +x
  std::optional<double> speed_mps;  ///< on the way to these points
  /// Direction of the camera: pitch above the horizon, yaw to the left of the heading, degrees.
  std::optional<std::array<double, 2>> gimbal_deg;
  std::optional<bool> beacon;
  std::optional<bool> return_home;
};

/// Commands of a client; absent members change nothing.
struct Commands {
  std::optional<std::int64_t> sequence;  ///< returned with the state that shows the effect
  std::optional<bool> paused;
  std::optional<double> factor;     ///< simulated seconds per second
  std::optional<std::string> view;  ///< id of the drone whose camera is shown
  std::vector<DroneCommand> drones;
};

/// Reads commands for a flight with these drones. Throws InputError with every mistake and its JSON
/// pointer: unknown fields and drones, values out of range, a gimbal that a drone does not have.
Commands commands_from_json(const nlohmann::json& value, const std::vector<FlownDrone>& drones);

/// The inverse of commands_from_json().
nlohmann::json to_json(const Commands& commands);

/// The JSON Schema of commands.
nlohmann::ordered_json commands_schema();

}  // namespace throng::live
