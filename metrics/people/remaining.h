// Why people are still inside when a run ends.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "metrics/basis/people.h"
#include "metrics/basis/walking_distance.h"
#include "world/scenario.h"
#include "world/trace.h"

namespace throng::metrics {

/// Everybody who took part, is present and inside at the last step and has not escaped: each
/// counts for the first reason that holds, in this order.
struct Remaining {
  int casualty = 0;  ///< lies there, hurt or fallen
  int guided = 0;    ///< follows a drone (world::kFollowing)
  int waiting = 0;   ///< heads for no exit: the behavior has not sent the person out
  int blocked = 0;   ///< no open exit can be reached on foot
  int walking = 0;   ///< arrived within the last minute, or is 6 m or more from where he or she was
                     ///< a minute ago (0.1 m/s)
  int stalled = 0;   ///< heads for an exit and does not get there

  int total() const { return casualty + guided + waiting + blocked + walking + stalled; }
};

/// `distances` is walking_distances() of the scenario.
Remaining count_remaining(const world::Trace& trace, const world::Scenario& scenario,
                          const std::vector<PersonRecord>& people,
                          const std::vector<WalkingDistance>& distances);

nlohmann::json to_json(const Remaining& remaining);

}  // namespace throng::metrics
