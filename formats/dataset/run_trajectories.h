// Reader for trajectories/RUN.npy and RUN.json: positions of all people at the times of a run's
// frames.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace throng::formats {

/// Number of values per person and frame: x, y, heading, state (docs/formats_pixels.md).
inline constexpr std::size_t kTrajectoryValues = 4;

struct RunTrajectories {
  std::vector<double> times_s;
  std::vector<std::int64_t> tracks;  ///< ascending
  std::vector<std::string> states;
  std::vector<float> values;  ///< (frames, people, kTrajectoryValues), row-major

  /// The kTrajectoryValues values of a person in a frame.
  const float* at(std::size_t frame, std::size_t person) const {
    return values.data() + (frame * tracks.size() + person) * kTrajectoryValues;
  }
  bool present(std::size_t frame, std::size_t person) const {
    return !std::isnan(*at(frame, person));
  }
  Eigen::Vector2d place(std::size_t frame, std::size_t person) const {
    const float* value = at(frame, person);
    return {static_cast<double>(value[0]), static_cast<double>(value[1])};
  }
};

/// Reads the trajectories of a dataset's run. Throws InputError for files with other shapes,
/// EnvironmentError, and nlohmann::json::exception.
RunTrajectories read_run_trajectories(const std::filesystem::path& root, const std::string& run);

}  // namespace throng::formats
