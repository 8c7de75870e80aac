// Everything that is asked of a flight from outside, until it is asked for something else.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "spec/live/commands.h"
#include "spec/sim/remote_command.h"

namespace throng::live {

/// Commands in force and the pace of the flight.
struct PilotInput {
  std::vector<sim::RemoteCommand> commands;  ///< per drone
  std::uint32_t sequence = 0;                ///< number of the newest commands
  double factor = 1;                         ///< simulated seconds per second
  bool paused = false;
  std::size_t view = 0;  ///< index of the drone whose camera is shown
};

/// Adds commands to the input of all pilots. `ids` are the drones', in the order of
/// PilotInput::commands; commands name no other ones.
void merge(const Commands& given, const std::vector<std::string>& ids, PilotInput& input);

/// Stops a drone whose pilot is gone. It still flies its route, or home.
void stop_moving(sim::RemoteCommand& command);

}  // namespace throng::live
