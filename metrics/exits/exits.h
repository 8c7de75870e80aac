// Time series of each exit: crossings, flow, density, queue, pressure, clogging. Definitions and
// sources: docs/metrics.md.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "metrics/density/edie.h"
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

std::string to_string(ExitState state);

/// One exit at one crowd step.
struct ExitSample {
  int in_zone = 0;                ///< people in the control zone who intend this exit
  double density_per_m2 = 0;      ///< in_zone / zone area
  double normalized_density = 0;  ///< density / close packing of the people's discs
  double approach_speed_mps = 0;  ///< mean speed toward the exit's middle
  int crossed_out = 0;            ///< outward crossings since the start
  int crossed_in = 0;             ///< inward crossings since the start
  double flow_per_s = 0;          ///< growth of net_out() per second over the last 4 s
  double since_crossing_s = 0;    ///< since the last outward crossing (or since the start)
  ExitState state = ExitState::idle;
  double clogging_index = 0;          ///< in [0, 1]
  double voronoi_density_per_m2 = 0;  ///< of all people, over the zone (metrics/density/voronoi.h)
  double specific_flow_per_ms = 0;    ///< flow per meter of width
  bool demand = false;                ///< enough people in the zone to fill the door
  int queue = 0;                      ///< people (metrics/exits/queue.h)
  double queue_length_m = 0;
  double predicted_wait_s = 0;                ///< metrics/exits/queue.h
  double pressure_per_s2 = 0;                 ///< greatest in the zone (metrics/density/pressure.h)
  ExitState state_offline = ExitState::idle;  ///< not causal: the whole gap of a clog is clogged

  int net_out() const { return crossed_out - crossed_in; }
};

/// A time without passages long enough to be a clog.
struct ClogEvent {
  double from_s = 0;  ///< the last passage before it, or when people came if that was later
  double until_s = 0;
  bool ended = true;        ///< otherwise the run ended first
  int people_at_onset = 0;  ///< in the zone
  double max_normalized_density = 0;
  double max_pressure_per_s2 = 0;
  std::vector<std::size_t> members;  ///< agents within 1.5 widths of the middle at any time of it
};

/// Somebody went out through a door.
struct Passage {
  double time_s = 0;  ///< on the line, between two steps
  std::size_t agent = 0;
};

struct ExitSeries {
  std::string exit_id;
  double width_m = 0;
  double zone_area_m2 = 0;
  std::vector<ExitSample> samples;     ///< one per trace step
  std::vector<Passage> passages = {};  ///< by time
  std::vector<ClogEvent> clogs = {};   ///< in order
  EdieRegion edie = {};                ///< those who intend the exit, in the zone, under demand
};

/// One series per exit of the scenario, at the trace's rate, causal except for values named
/// "offline" and the clogs: a sample depends only on the trace up to its step.
std::vector<ExitSeries> exit_series(const world::Trace& trace, const world::Scenario& scenario);

}  // namespace throng::metrics
