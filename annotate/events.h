// Events of a run: escapes, falls, collisions and the like.
#pragma once

#include <span>
#include <string>

#include "world/scenario.h"
#include "world/trace.h"

namespace throng::annotate {

/// One JSON object a line, by time (docs/formats_pixels.md#events): the trace's events, and those
/// that its people's states and flags show: arrival, notice, start and end of lying, panic and
/// following a drone, escape, departure. `frame_times_s` are the times of the run's frames; an
/// event has the number of the last frame that is not after it.
std::string events_jsonl(const world::Trace& trace, const world::Scenario& scenario, int run,
                         std::span<const double> frame_times_s);

}  // namespace throng::annotate
