// "signage": a moving exit sign: hovers before the exit at which people get out soonest, calls
// those who are near, and lets them go once they can walk through it.
#pragma once

#include <memory>

#include "sim/policies/policy.h"

namespace throng::sim {

std::unique_ptr<Policy> make_signage_policy(const PolicyContext& context);

}  // namespace throng::sim
