// Positions of all people of a run at the times of its frames, seen by cameras or not.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "world/trace.h"

namespace throng::annotate {

/// Values of a person at a time: x, y (m), heading (rad, counter-clockwise from +x), number of the
/// behavior's state (TraceHeader::state_names).
inline constexpr int kTrajectoryValues = 4;

struct Trajectories {
  std::vector<std::uint32_t> agents;  ///< people of the run, in ascending order
  std::size_t frames = 0;
  /// (frames, agents, kTrajectoryValues), row-major; NaN where a person has not arrived or has
  /// left.
  std::vector<float> values;
};

/// Positions of the people whom the renderer draws, linear between the steps of the trace as in
/// images.
Trajectories trajectories_at(const world::Trace& trace, std::span<const double> times_s);

/// The bytes of a .npy file, float32, C order.
std::string npy_bytes(const Trajectories& trajectories);

}  // namespace throng::annotate
