// Reading and writing of trajectory files of pedestrian research: text and tables, databases and
// files of simulators.
#pragma once

#include <filesystem>
#include <vector>

#include "base/error.h"
#include "spec/metrics/trajectory_format.h"
#include "world/scenario.h"
#include "world/trace.h"

namespace throng::metrics {

/// Reads a file as a trace of people without states and intents. The format, unless given, is
/// detected by suffix and content (also of UTF-16 and, for text, of gzip):
/// - suffix .scb: Menge's;
/// - SQLite: JuPedSim's;
/// - HDF5: of the Pedestrian Dynamics Data Archive of Jülich;
/// - XML: SUMO's FCD output; JSON: Pathfinder's, or lines of TrajNet++;
/// - else a table or text (table_reader.h): JuPedSim, PedPy, PeTrack, Pathfinder, Crowd:it, Vadere,
///   Viswalk, ETH/UCY, TrajNet, spreadsheets.
/// If all differences of frame numbers are multiples of a number up to 100, frames are renumbered
/// and the rate is divided by it.
/// Velocities are central differences over the previous and the next frame. People are present in
/// the frames that contain them. Throws InputError (file, line), also for positions more than 100
/// km from the origin, rates below 0.01 or above 10 000 per second, more than 40 million pairs of
/// frame and person, and speeds that tell that a unit which nobody states is not the meter; and
/// EnvironmentError. `notes` receives warnings: speeds that no human has, with the id and frames of
/// the file, and what was left out.
world::Trace read_trajectory(const std::filesystem::path& file, const WalkerDefaults& walkers,
                             const TrajectoryFormat& format = {},
                             std::vector<Problem>* notes = nullptr);

/// Writes the people of a trace: SQLite for the suffix .sqlite, Menge's format for .scb, else text.
/// Frames are the trace's steps, ids are its agents, from 1. `scenario`: its ground without its
/// buildings is the walkable area of SQLite; null: the box around all people. Throws
/// EnvironmentError.
void write_trajectory(const world::Trace& trace, const std::filesystem::path& file,
                      const world::Scenario* scenario = nullptr);

}  // namespace throng::metrics
