// The policy "balance": leads people from the exit with the longest wait to the exit at which they
// get out soonest, in batches that make both waits equal. Drones coordinate by announcing their
// plans to each other. People who stand or have not noticed the alarm are led last.
#pragma once

#include <memory>

#include "sim/policies/policy.h"

namespace throng::sim {

std::unique_ptr<Policy> make_balance_policy(const PolicyContext& context);

}  // namespace throng::sim
