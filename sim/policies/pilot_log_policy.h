// The policy "pilot_log": repeats recorded set-points (sim/recording/pilot_log.h).
#pragma once

#include <memory>

#include "sim/policies/policy.h"

namespace throng::sim {

std::unique_ptr<Policy> make_pilot_log_policy(const PolicyContext& context);

}  // namespace throng::sim
