// Everybody's places at some times of a run: a part of a trace, read without the rest.
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

/// Arrays over [time][agent] are row-major.
struct Trajectories {
  std::vector<AgentRole> role;            ///< per agent
  std::vector<double> time_s;             ///< as asked for
  std::vector<Eigen::Vector2f> position;  ///< m
  std::vector<std::uint8_t> state;        ///< index into TraceHeader::state_names
  std::vector<std::uint8_t> flags;        ///< kPresent, kPanicked, kFallen, kFollowing
};

/// One trace, from which parts are read. HDF5 is not used from several threads at once: the caller
/// sees to that.
class TrajectoryReader {
 public:
  /// Throws EnvironmentError when the file cannot be read, InputError when it is not a trace.
  explicit TrajectoryReader(const std::filesystem::path& trace);
  ~TrajectoryReader();
  TrajectoryReader(const TrajectoryReader&) = delete;
  TrajectoryReader& operator=(const TrajectoryReader&) = delete;

  std::size_t agents() const;
  double end_s() const;

  /// At these times of 0 to end_s(). Between two steps positions are on the straight line between
  /// both, where an agent takes part in both; the rest is that of the earlier step. Throws as the
  /// constructor.
  Trajectories at(std::span<const double> time_s) const;

 private:
  struct File;
  std::unique_ptr<File> file_;
};

}  // namespace throng::world
