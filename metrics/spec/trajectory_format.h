// What a user says of a trajectory file (metrics/trajectory_file.h reads it).
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace throng::metrics {

/// What such files do not say of people.
struct WalkerDefaults {
  double radius_m = 0.2;
  double desired_speed_mps = 1.34;  ///< Weidmann 1993
};

/// What kind of file it is. any: by suffix and first bytes, as read_trajectory() says.
enum class TrajectoryKind : std::uint8_t { any, text, sqlite, scb, csv };

/// Names in the first line of a table, or, where all are whole numbers, the columns of one without
/// names, from 1. Either `frame` or `time` says when; the other is empty.
struct TrajectoryColumns {
  std::string person = "id";
  std::string frame = "frame";
  std::string time;  ///< s
  std::string x = "x";
  std::string y = "y";
};

/// What the user says of a file, instead of what it says itself or has no place for.
struct TrajectoryFormat {
  TrajectoryKind kind = TrajectoryKind::any;
  std::optional<double> frames_per_s;
  std::optional<double> unit_m;  ///< length of the file's unit, m
  TrajectoryColumns columns;     ///< csv
};

}  // namespace throng::metrics
