// Values of an exit over time. Definitions and sources: docs/metrics.md.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "metrics/density/edie.h"

namespace throng::metrics {

/// States of an exit; metrics/exits/exit_state.h defines the transitions.
enum class ExitState : std::uint8_t {
  idle = 0,
  flowing = 1,
  congested = 2,
  clogged = 3,
  closed = 4
};

std::string to_string(ExitState state);

/// An exit at one step of the crowd.
struct ExitSample {
  int in_zone = 0;                ///< people in the control zone who intend this exit
  double density_per_m2 = 0;      ///< in_zone / zone area
  double normalized_density = 0;  ///< density / close packing of the people's discs
  double approach_speed_mps = 0;  ///< mean speed toward the exit's middle
  int crossed_out = 0;            ///< outward crossings since the start
  int crossed_in = 0;             ///< inward crossings since the start
  double flow_per_s = 0;          ///< growth of net_out() per second over the last 4 s
  double since_crossing_s = 0;    ///< time since the last outward crossing, or the start
  ExitState state = ExitState::idle;
  double clogging_index = 0;          ///< in [0, 1]
  double voronoi_density_per_m2 = 0;  ///< over the zone, of all people (metrics/density/voronoi.h)
  double specific_flow_per_ms = 0;    ///< flow per meter of width
  bool demand = false;                ///< enough people in the zone to fill the door
  int queue = 0;                      ///< number of people (metrics/exits/queue.h)
  double queue_length_m = 0;
  double predicted_wait_s = 0;                ///< metrics/exits/queue.h
  double pressure_per_s2 = 0;                 ///< max in the zone (metrics/density/pressure.h)
  ExitState state_offline = ExitState::idle;  ///< not causal: clogged during the whole gap

  int net_out() const { return crossed_out - crossed_in; }
};

/// A clog: an interval without passages that exceeds clog_after_s().
struct ClogEvent {
  double from_s = 0;  ///< the later of the last passage and the start of demand
  double until_s = 0;
  bool ended = true;        ///< false: lasts until the end of the run
  int people_at_onset = 0;  ///< number of people in the zone at its start
  double max_normalized_density = 0;
  double max_pressure_per_s2 = 0;
  std::vector<std::size_t> members;  ///< agents within 1.5 widths of the door's center during it
};

/// A passage of a person outward through a door.
struct Passage {
  double time_s = 0;  ///< interpolated time on the line
  std::size_t agent = 0;
};

/// The time series of an exit.
struct ExitSeries {
  std::string exit_id;
  double width_m = 0;
  double capacity_per_s = 0;  ///< people, while open (metrics/exits/exit_state.h)
  std::string capacity_source = "nominal";
  double zone_area_m2 = 0;
  std::vector<ExitSample> samples = {};  ///< one per trace step
  std::vector<Passage> passages = {};    ///< in order of time
  std::vector<ClogEvent> clogs = {};     ///< in order of time
  EdieRegion edie = {};  ///< people who intend the exit, over the zone during demand
};

}  // namespace throng::metrics
