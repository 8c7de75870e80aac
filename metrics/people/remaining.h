// The reasons why people are still inside at the end of a run.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "metrics/basis/people.h"
#include "metrics/basis/walking_distance.h"
#include "world/scenario.h"
#include "world/trace.h"

namespace throng::metrics {

/// Numbers of people who are present and inside at the last step and have not escaped. Each person
/// counts for the first reason that applies, in this order.
struct Remaining {
  int casualty = 0;  ///< lies on the ground, hurt or fallen
  int guided = 0;    ///< follows a drone (world::kFollowing)
  int waiting = 0;   ///< does not head for an exit, since the behavior has not set one as goal
  int blocked = 0;   ///< cannot reach an open exit on foot
  int walking = 0;   ///< arrived within the last minute, or moved by 6 m or more in it (0.1 m/s)
  int stalled = 0;   ///< heads for an exit without progress

  int total() const { return casualty + guided + waiting + blocked + walking + stalled; }
};

/// `distances` is walking_distances() of the scenario.
Remaining count_remaining(const world::Trace& trace, const world::Scenario& scenario,
                          const std::vector<PersonRecord>& people,
                          const std::vector<WalkingDistance>& distances);

nlohmann::json to_json(const Remaining& remaining);

}  // namespace throng::metrics
