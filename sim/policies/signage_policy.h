// The policy "signage", a moving exit sign: hovers in front of the exit at which people get out
// soonest, attracts people nearby, and releases them so that they walk through it.
#pragma once

#include <memory>

#include "sim/policies/policy.h"

namespace throng::sim {

std::unique_ptr<Policy> make_signage_policy(const PolicyContext& context);

}  // namespace throng::sim
