// Positions and states of all agents at selected times, read from a trace without its other data.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "world/trace.h"

namespace throng::world {

/// Trajectories at selected times. Arrays over [time][agent] are row-major.
struct Trajectories {
  std::vector<AgentRole> role;            ///< per agent
  std::vector<double> time_s;             ///< the requested times
  std::vector<Eigen::Vector2f> position;  ///< m
  std::vector<std::uint8_t> state;        ///< index into TraceHeader::state_names
  std::vector<std::uint8_t> flags;        ///< kPresent, kPanicked, kFallen, kFollowing
};

/// Reads parts of one trace. HDF5 is not thread-safe: callers must not use it from several threads
/// at the same time.
class TrajectoryReader {
 public:
  /// Throws EnvironmentError when the file cannot be read, InputError when it is not a trace.
  explicit TrajectoryReader(const std::filesystem::path& trace);
  ~TrajectoryReader();
  TrajectoryReader(const TrajectoryReader&) = delete;
  TrajectoryReader& operator=(const TrajectoryReader&) = delete;

  std::size_t agents() const;
  /// Time of the last step.
  double end_s() const;

  /// Returns the agents at these times, each from 0 to end_s(). Positions between two steps are
  /// interpolated linearly if the agent is present at the later step; states and flags are those of
  /// the earlier step. Throws like the constructor.
  Trajectories at(std::span<const double> time_s) const;

 private:
  struct File;
  std::unique_ptr<File> file_;
};

}  // namespace throng::world
