// Trajectories as pedestrian researchers exchange them: the text format of JuPedSim and PedPy, and
// JuPedSim's SQLite database.
#pragma once

#include <filesystem>

#include "world/trace.h"

namespace throng::metrics {

/// What such files do not say of people.
struct WalkerDefaults {
  double radius_m = 0.2;
  double desired_speed_mps = 1.34;  ///< Weidmann 1993
};

/// Reads a file as a trace of people without states and intents. SQLite by its first bytes: tables
/// `trajectory_data` (frame, id, pos_x, pos_y in m) and `metadata` (fps). Else text: lines
/// `id frame x y ...` with spaces, tabs or commas between, `#` before comments, of which
/// `framerate: 16` (or `fps`) must be one, and `x/cm` says that lengths are in centimetres.
/// Velocities are central differences over one frame before and after. People take part in the
/// frames that have them. Throws InputError (file, line) and EnvironmentError.
world::Trace read_trajectory(const std::filesystem::path& file, const WalkerDefaults& walkers);

/// Writes the people of a trace: SQLite for the suffix .sqlite, else text. Frames are the trace's
/// steps, ids its agents from 1. Throws EnvironmentError.
void write_trajectory(const world::Trace& trace, const std::filesystem::path& file);

}  // namespace throng::metrics
