// What became of each person of a run.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "world/scenario.h"
#include "world/trace.h"

namespace throng::metrics {

struct PersonRecord {
  std::size_t agent = 0;
  std::size_t first_step = 0;  ///< the first one at which the person takes part
  double arrived_s = 0;
  std::optional<double> noticed_s;  ///< first heads for an exit, or follows a guide
  std::optional<double> escaped_s;  ///< first outside of Scenario::inside, or gone for good
  std::optional<double> hurt_s;     ///< lies from then on in a state that says so, to the end
  double followed_s = 0;            ///< time in states whose name contains "follow"
  double followed_m = 0;            ///< way walked in them
};

/// Everybody who took part at any time, by number of the agent.
std::vector<PersonRecord> person_records(const world::Trace& trace, const world::Rectangle& inside);

}  // namespace throng::metrics
