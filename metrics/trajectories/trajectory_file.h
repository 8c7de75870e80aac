// Reading and writing of trajectory files of pedestrian research: the text format of JuPedSim and
// PedPy, JuPedSim's SQLite database, Menge's .scb, and tables (CSV) whose columns the user names.
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
  double unit_m = 1;  ///< as stated in the file
  std::map<std::int64_t, std::map<std::int64_t, Eigen::Vector2d>> places;  ///< by person and frame,
                                                                           ///< in the file's unit
};

/// Reads Menge's .scb from version 2.0 on (1.0 does not contain the frame duration); agents are
/// people with ids from 1. Throws InputError and EnvironmentError.
Recorded read_scb(const std::filesystem::path& file);
/// Writes the people of a trace as .scb 2.1, with class 0. Throws EnvironmentError.
void write_scb(const world::Trace& trace, const std::filesystem::path& file);

/// Reads a table; `name` names it in messages. The first line that is neither empty nor a comment
/// (#) names the columns. The separator is the one of comma, semicolon and tab that this line has
/// most of, or else the space; fields may be in double quotes. Default names in `format` also match
/// synonyms ("ped_id", "Pos_X [cm]"), and a time column replaces a missing frame column. Comments
/// and the name of x may state frame rate and unit. Ids of persons are arbitrary words. With times
/// instead of frames, positions are interpolated linearly at `frames_per_s` (default: as stated in
/// the file, else by the median time step); people are absent in gaps of more than 1 s. Throws
/// InputError.
Recorded read_csv(std::string_view text, const std::string& name, const TrajectoryFormat& format);

/// Reads a file as a trace of people without states and intents. The format, unless given, is
/// detected:
/// - suffix .csv: a table (read_csv()); suffix .scb: Menge's;
/// - SQLite by its first bytes: tables `trajectory_data` (frame, id, pos_x, pos_y in m) and
///   `metadata` (fps);
/// - a table if the first line that is no comment begins with a letter;
/// - else text: lines `id frame x y ...`, separated by spaces, tabs or commas. Comments (#) must
///   state the frame rate (`framerate: 16` or `25 fps`) and may state centimeters (`x/cm`, `in
///   cm`).
/// If all differences of frame numbers are multiples of a number up to 100, frames are renumbered
/// and the rate is divided by it.
/// Velocities are central differences over the previous and the next frame. People are present in
/// the frames that contain them. Throws InputError (file, line), also for positions more than 100
/// km from the origin, rates below 0.01 or above 10 000 per second, and more than 40 million pairs
/// of frame and person; and EnvironmentError.
world::Trace read_trajectory(const std::filesystem::path& file, const WalkerDefaults& walkers,
                             const TrajectoryFormat& format = {});

/// Writes the people of a trace: SQLite for the suffix .sqlite, Menge's format for .scb, else text.
/// Frames are the trace's steps, ids are its agents, from 1. Throws EnvironmentError.
void write_trajectory(const world::Trace& trace, const std::filesystem::path& file);

}  // namespace throng::metrics
