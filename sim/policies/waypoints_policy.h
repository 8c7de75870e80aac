// The policy "waypoints": flies from point to point along straight lines and hovers at the last
// one. The set-point moves along the path at the mission's speed, slows down for corners (to a stop
// where the path turns back) and for the end, and waits for a drone that falls behind.
#pragma once

#include <memory>

#include "sim/policies/policy.h"

namespace throng::sim {

std::unique_ptr<Policy> make_waypoints_policy(const PolicyContext& context);

}  // namespace throng::sim
