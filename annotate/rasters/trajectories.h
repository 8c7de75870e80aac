// Positions of all people of a run at the times of its frames, whether cameras see them or not.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "world/trace.h"

namespace throng::annotate {

/// Number of values of a person at a time: x, y (m), heading (rad, counter-clockwise from +x), and
/// the index of the behavior's state in TraceHeader::state_names.
inline constexpr int kTrajectoryValues = 4;

/// Trajectories sampled at the frames of a run.
struct Trajectories {
  std::vector<std::uint32_t> agents;  ///< ids of the run's people, in ascending order
  std::size_t frames = 0;
  /// Row-major, shape (frames, agents, kTrajectoryValues); NaN before a person arrives and after
  /// they leave.
  std::vector<float> values;
};

/// Samples the trajectories of people and attackers at these times, interpolated linearly between
/// the steps of the trace as in images.
Trajectories trajectories_at(const world::Trace& trace, std::span<const double> times_s);

/// The bytes of a .npy file, float32, C order, with the shape of Trajectories::values.
std::string npy_bytes(const Trajectories& trajectories);

}  // namespace throng::annotate
