// Recorded laboratory experiments: geometry, boundary conditions, and the places of measurement.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "crowd/validation/flow.h"
#include "crowd/validation/scene.h"
#include "spec/metrics/trajectory_format.h"

namespace throng::validation {

/// Free speeds of the people of an experiment, m/s: a normal distribution, truncated at three
/// standard deviations and to 0.3 to 2.5 m/s.
struct FreeSpeeds {
  double mean_mps = 1.34;
  double stddev_mps = 0.26;

  Sampled sampled() const;
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
  Polygon walkable;                ///< outline of the ground, m
  std::vector<Polygon> obstacles;  ///< solid, inside of the outline, m
  std::vector<Eigen::AlignedBox2d>
      goals;                 ///< one per stream, m; those that nobody uses are ignored
  Eigen::AlignedBox2d area;  ///< where density and speed are measured, m
  CountingLine line;
  /// Period of the steady state, from the first frame on; by default from the 20th to the 80th
  /// percentile of the passages of the line.
  std::optional<TimeRange> steady;
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
  double from_x_m = 0;  ///< part of the straight in which people are measured
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

/// Reads the experiments of a folder: those that its file experiments.json describes
/// (docs/validation.md), and other files whose names are those of experiments of the Pedestrian
/// Dynamics Data Archive (archive.h); with corridors of Hermes, also their diagram. Sorted by name.
/// Opens no recording. Throws InputError for a file that is wrong, for two experiments of the same
/// name, and if there is none.
std::vector<Experiment> find_experiments(const std::filesystem::path& folder);

/// Reads the text of an experiments.json; files are relative to `folder`. Throws InputError.
std::vector<Experiment> parse_experiments(std::string_view text,
                                          const std::filesystem::path& folder);

}  // namespace throng::validation
