// What happens at each exit over time: crossings, flow, density, queue, clogging index.
// Definitions and sources: docs/metrics.md.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "world/scenario.h"
#include "world/trace.h"

namespace throng::metrics {

enum class ExitState : std::uint8_t {
  idle = 0,
  flowing = 1,
  congested = 2,
  clogged = 3,
  closed = 4
};

std::string name_of(ExitState state);

/// One exit at one crowd step.
struct ExitSample {
  int in_zone = 0;                ///< people in the control zone who intend this exit
  double density_per_m2 = 0;      ///< in_zone / zone area
  double normalised_density = 0;  ///< density / close packing of the people's discs
  double approach_speed_mps = 0;  ///< mean speed towards the exit's middle
  int crossed = 0;                ///< cumulative signed crossings, outward positive
  double flow_per_s = 0;          ///< crossings per second over the last 4 s
  double since_crossing_s = 0;    ///< since the last outward crossing (or since the start)
  ExitState state = ExitState::idle;
  double clogging_index = 0;  ///< in [0, 1]
};

struct ExitSeries {
  std::string exit_id;
  double width_m = 0;
  double zone_area_m2 = 0;
  std::vector<ExitSample> samples;  ///< one per trace step
};

/// One series per exit of the scenario, at the trace's rate, causal: a sample depends only on the
/// trace up to its step.
std::vector<ExitSeries> exit_series(const world::Trace& trace, const world::Scenario& scenario);

}  // namespace throng::metrics
