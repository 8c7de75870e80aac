// Recorded laboratory experiments as experiments.json describes them (docs/validation.md):
// geometry, boundary conditions, and the places of measurement.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "spec/metrics/trajectory_format.h"

namespace throng::validation {

/// Free speeds of the people of an experiment, m/s: a normal distribution, truncated at three
/// standard deviations and to kMinMps to kMaxMps.
struct FreeSpeeds {
  static constexpr double kMinMps = 0.3;
  static constexpr double kMaxMps = 2.5;  ///< max_speed of people in scenes

  double mean_mps = 1.34;
  double stddev_mps = 0.26;
};

/// A line across the way at which people are counted; they may pass it in both directions.
struct CountingLine {
  Eigen::Vector2d from;
  Eigen::Vector2d to;

  double length_m() const { return (to - from).norm(); }
};

/// An interval of time, s.
struct TimeRange {
  double from_s = 0;
  double until_s = 0;
};

/// People who were filmed while they walked through a place: everybody enters where and when the
/// recording begins to show them, and walks to the goal of their stream.
struct Recording {
  std::filesystem::path file;
  metrics::TrajectoryFormat format;
  std::vector<Eigen::Vector2d> walkable;                ///< outline of the ground, m
  std::vector<std::vector<Eigen::Vector2d>> obstacles;  ///< solid, inside of the outline, m
  std::vector<Eigen::AlignedBox2d>
      goals;                 ///< one per stream, m; those that nobody uses are ignored
  Eigen::AlignedBox2d area;  ///< where density and speed are measured, m
  CountingLine line;
  /// Period of the steady state, from the first frame on; by default from the 20th to the 80th
  /// percentile of the passages of the line.
  std::optional<TimeRange> steady;
};

/// A mean speed at a density.
struct DensitySpeed {
  double density = 0;  ///< 1/m^2
  double speed_mps = 0;
};

/// People who were filmed while they walked around in a closed corridor. The model walks in a ring
/// of the same width and length.
struct Loop {
  double length_m = 80;
  double width_m = 1.8;
  /// Densities (1/m^2) and mean speeds; if the recording has a file, its own are measured there.
  std::vector<DensitySpeed> recorded;
};

/// Single file in a straight part of a closed corridor.
struct SingleFile {
  std::filesystem::path file;
  metrics::TrajectoryFormat format;
  std::size_t people = 0;  ///< in the whole corridor
  double width_m = 0.8;
  /// Part of the straight in which people are measured; where both are equal, the part that was
  /// filmed.
  double from_x_m = 0;
  double until_x_m = 0;
};

/// One experiment; exactly one of the optional parts is set.
struct Experiment {
  std::string name;
  FreeSpeeds free_speeds;
  std::optional<Recording> recording;
  std::optional<Loop> loop;
  std::optional<SingleFile> single_file;
};

/// Reads the text of an experiments.json; files are relative to `folder`. Throws InputError.
std::vector<Experiment> parse_experiments(std::string_view text,
                                          const std::filesystem::path& folder);

/// The JSON Schema of an experiments.json.
nlohmann::ordered_json experiments_schema();

}  // namespace throng::validation
