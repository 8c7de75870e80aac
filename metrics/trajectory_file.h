// Trajectories as pedestrian researchers exchange them: the text format of JuPedSim and PedPy,
// JuPedSim's SQLite database, and Menge's .scb.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <map>

#include "world/trace.h"

namespace throng::metrics {

/// What such files do not say of people.
struct WalkerDefaults {
  double radius_m = 0.2;
  double desired_speed_mps = 1.34;  ///< Weidmann 1993
};

/// Where everybody was, as files have it.
struct Recorded {
  double frames_per_s = 0;
  std::map<std::int64_t, std::map<std::int64_t, Eigen::Vector2d>> places;  ///< by person and frame
};

/// Reads Menge's .scb from version 2.0 on (1.0 does not say how long a frame is); agents are people
/// with ids from 1. Throws InputError and EnvironmentError.
Recorded read_scb(const std::filesystem::path& file);
/// Writes the people of a trace as .scb 2.1, their class being 0.
void write_scb(const world::Trace& trace, const std::filesystem::path& file);

/// Reads a file as a trace of people without states and intents. Menge's by the suffix .scb; SQLite
/// by its first bytes: tables `trajectory_data` (frame, id, pos_x, pos_y in m) and `metadata`
/// (fps). Else text: lines `id frame x y ...` with spaces, tabs or commas between, `#` before
/// comments, of which `framerate: 16` (or `fps`) must be one, and `x/cm` says that lengths are in
/// centimetres. Velocities are central differences over one frame before and after. People take
/// part in the frames that have them. Throws InputError (file, line) and EnvironmentError.
world::Trace read_trajectory(const std::filesystem::path& file, const WalkerDefaults& walkers);

/// Writes the people of a trace: SQLite for the suffix .sqlite, Menge's for .scb, else text. Frames
/// are the trace's steps, ids its agents from 1. Throws EnvironmentError.
void write_trajectory(const world::Trace& trace, const std::filesystem::path& file);

}  // namespace throng::metrics
