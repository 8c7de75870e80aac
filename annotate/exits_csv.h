// exits.csv: the state of each exit at the time of each frame.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "metrics/exits/exits.h"

namespace throng::annotate {

/// Index and time of a frame.
struct FrameTime {
  std::int64_t frame_index = 0;
  double time_s = 0;
};

/// A CSV table with a header line and one row per frame and exit: frame, time_s, exit, in_zone,
/// density, normalized_density, approach_speed, crossed_out, crossed_in, flow, since_crossing,
/// state, clogging_index, voronoi_density, specific_flow, demand, queue, queue_length,
/// predicted_wait, pressure, state_offline (units: docs/metrics.md). `step_times_s` are the times
/// of the samples in `exits`; a frame gets the last sample at or before it, or else the first
/// sample.
std::string exits_csv(const std::vector<metrics::ExitSeries>& exits,
                      std::span<const double> step_times_s, std::span<const FrameTime> frames);

}  // namespace throng::annotate
