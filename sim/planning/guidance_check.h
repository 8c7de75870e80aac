// Whether a mission's parameters are those that its policy needs and takes, and make sense.
#pragma once

#include <string>
#include <vector>

#include "base/error.h"
#include "sim/policies/policy.h"

namespace throng::sim {

/// Adds what is wrong to `problems`; `pointer` is that of the job's "guidance".
void check_guidance(const PolicyEntry& policy, const DroneMission& mission,
                    const world::Scenario& scenario, const std::string& pointer,
                    std::vector<Problem>& problems);

}  // namespace throng::sim
