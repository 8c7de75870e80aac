// Trajectories as pedestrian researchers exchange them: the text format of JuPedSim and PedPy,
// JuPedSim's SQLite database, Menge's .scb, and tables (CSV) whose columns the user names.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "spec/metrics/trajectory_format.h"
#include "world/trace.h"

namespace throng::metrics {

/// Positions of all people, as read from a file.
struct Recorded {
  double frames_per_s = 0;
  double unit_m = 1;                                                       ///< as given in the file
  std::map<std::int64_t, std::map<std::int64_t, Eigen::Vector2d>> places;  ///< by person and frame,
                                                                           ///< in the file's unit
};

/// Reads Menge's .scb from version 2.0 on (1.0 does not contain the frame duration); agents are
/// people with ids from 1. Throws InputError and EnvironmentError.
Recorded read_scb(const std::filesystem::path& file);
/// Writes the people of a trace as .scb 2.1, their class being 0.
void write_scb(const world::Trace& trace, const std::filesystem::path& file);

/// Reads a table: the first line that is not empty and does not begin with # names the columns,
/// which commas, semicolons, tabs or, if it has none, spaces separate (whichever that line has most
/// of); fields may stand in double quotes. A default name also stands for what means the same
/// ("ped_id", "Pos_X [cm]"), and time for frame where there is none. Comments and the name of x may
/// give frame rate and unit. Persons are any words. With a column of times instead of frames,
/// people are put on frames of `frames_per_s` (default: as given in the file, else the median step
/// between times) by linear interpolation; they are not there in gaps of more than 1 s.
Recorded read_csv(std::string_view text, const std::string& name, const TrajectoryFormat& format);

/// Reads a file as a trace of people without states and intents. Tables (read_csv) by the suffix
/// .csv and Menge's by .scb; SQLite by its first bytes: tables `trajectory_data` (frame, id, pos_x,
/// pos_y in m) and `metadata` (fps). Else, if the first line that is no comment begins with a
/// letter, a table, or text: lines `id frame x y ...` with spaces, tabs or commas between, `#`
/// before comments, of which `framerate: 16` (or `25 fps`) must be one, and `x/cm` or `in cm` gives
/// that lengths are in centimeters. Frames that are all a multiple of up to 100 apart are counted
/// by it, at the rate divided by it. Velocities are central differences over one frame before and
/// after. People take part in the frames that have them. Refused are places more than 100 km from
/// the origin, rates below 0.01 or above 10 000 a second, and more than 40 million pairs of frame
/// and person. Throws InputError (file, line) and EnvironmentError.
world::Trace read_trajectory(const std::filesystem::path& file, const WalkerDefaults& walkers,
                             const TrajectoryFormat& format = {});

/// Writes the people of a trace: SQLite for the suffix .sqlite, Menge's for .scb, else text. Frames
/// are the trace's steps, ids its agents from 1. Throws EnvironmentError.
void write_trajectory(const world::Trace& trace, const std::filesystem::path& file);

}  // namespace throng::metrics
