// A user's description of a trajectory file (metrics/trajectories/trajectory_file.h reads it).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

namespace throng::metrics {

/// Properties of people that trajectory files do not contain.
struct WalkerDefaults {
  double radius_m = 0.2;
  double desired_speed_mps = 1.34;  ///< mean of Weidmann 1993
};

/// File format. any: detected by suffix and first bytes, as read_trajectory() documents.
enum class TrajectoryKind : std::uint8_t { any, text, sqlite, scb, csv, hdf5, fcd, json_text };

/// Units of length by the words of users.
struct LengthUnit {
  const char* word;
  double meters;
};
inline constexpr std::array<LengthUnit, 4> kLengthUnits = {
    {{"m", 1}, {"cm", 0.01}, {"mm", 0.001}, {"ft", 0.3048}}};

/// Columns of a table or text by their names in its header; or, if all are integers, by their
/// numbers from 1. Either `frame` or `time` is given; the other is empty.
struct TrajectoryColumns {
  std::string person = "id";
  std::string frame = "frame";
  std::string time;  ///< s
  std::string x = "x";
  std::string y = "y";
};

/// Returns the columns that a list of roles gives in their order, such as "frame,id,x,y": "id" (or
/// "person"), "frame" or "time", "x" and "y"; other columns have any other word. Throws InputError
/// if one of them is missing or given twice.
TrajectoryColumns columns_in_order(const std::string& roles);

/// The user's values for a file; they override or complete those in the file.
struct TrajectoryFormat {
  TrajectoryKind kind = TrajectoryKind::any;
  std::optional<double> frames_per_s;
  std::optional<double> unit_m;  ///< length of the file's unit of coordinates (m)
  TrajectoryColumns columns;     ///< only of tables and text
};

}  // namespace throng::metrics
