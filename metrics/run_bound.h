// How soon the people of a run could have been out at best, as they noticed and as fast as they
// are.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <vector>

#include "metrics/people.h"
#include "metrics/walking_distance.h"
#include "world/scenario.h"
#include "world/trace.h"

namespace throng::metrics {

/// From where and when each person noticed, at the greatest speed that they desired in the run, on
/// the shortest way around buildings to any exit while it is open; exits take their capacity. Who
/// never noticed and escaped all the same sets out when they arrive, who did neither never does.
struct RunBound {
  double from_s = 0;          ///< the earliest notice; all times count from then
  std::vector<double> out_s;  ///< one per person, in order; infinite for those who never set out
  double mean_s = 0;          ///< who is not out by the end of the run counts with that
  double mean_of_run_s = 0;   ///< the same of the run itself
};

/// Empty when nobody noticed, nobody wants to move or there is no exit. `ways`: ways_to_exits().
std::optional<RunBound> run_bound(const world::Trace& trace, const world::Scenario& scenario,
                                  const std::vector<PersonRecord>& people,
                                  const std::vector<WalkingDistance>& ways);

/// The bound's times, and the ratios of those of the run to them. `escape_s`: of those who escaped,
/// in order, by the run's clock.
nlohmann::json to_json(const std::optional<RunBound>& bound, const std::vector<double>& escape_s);

/// Ratio of the time by which `percent` % had escaped, since the earliest notice, to the bound's.
/// Empty if either was not reached, or the bound is 0.
std::optional<double> ratio_to_bound(const RunBound& bound, const std::vector<double>& escape_s,
                                     int percent);

}  // namespace throng::metrics
