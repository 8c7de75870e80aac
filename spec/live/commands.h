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

/// For one drone; what is not given stays as it is.
struct DroneCommand {
  std::string id;
  std::optional<std::array<double, 3>> velocity_mps;  ///< ahead, to the left, up
  std::optional<double> yaw_rate_deg_s;               ///< counter-clockwise
  std::optional<bool> beacon;
  std::optional<bool> return_home;
};

struct Commands {
  std::optional<std::int64_t> sequence;  ///< comes back with what shows the effect
  std::optional<bool> paused;
  std::optional<double> factor;     ///< simulated seconds per second
  std::optional<std::string> view;  ///< the drone whose camera is shown
  std::vector<DroneCommand> drones;
};

/// Throws InputError with every mistake and its JSON pointer: unknown fields and drones, values out
/// of range.
Commands commands_from_json(const nlohmann::json& value, const std::vector<std::string>& drones);

/// The same as text that commands_from_json() reads.
nlohmann::json to_json(const Commands& commands);

}  // namespace throng::live
