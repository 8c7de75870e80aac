// Events of a run, such as escapes, falls and collisions.
#pragma once

#include <span>
#include <string>

#include "world/scenario.h"
#include "world/trace.h"

namespace throng::annotate {

/// JSON lines, sorted by time (docs/formats_pixels.md#events): the events recorded in the trace,
/// and those derived from its people's states and flags: arrival, notice, start and end of lying,
/// panic and following a drone, escape, departure. `frame_times_s` are the times of the run's
/// frames, in rising order; an event gets the index of the last frame that is not after it.
std::string events_jsonl(const world::Trace& trace, const world::Scenario& scenario, int run,
                         std::span<const double> frame_times_s);

}  // namespace throng::annotate
