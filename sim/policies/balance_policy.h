// "balance": takes people from where they would wait longest and leads them to the exit at which
// they get out soonest, in batches that leave both queues equally long. Several drones share the
// work by announcing their plans to each other; people who are standing or have not noticed come
// last.
#pragma once

#include <memory>

#include "sim/policies/policy.h"

namespace throng::sim {

std::unique_ptr<Policy> make_balance_policy(const PolicyContext& context);

}  // namespace throng::sim
