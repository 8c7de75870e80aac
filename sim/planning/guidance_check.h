// Checks that a mission has the parameters of its policy, and only these, with valid values.
#pragma once

#include <string>
#include <vector>

#include "base/error.h"
#include "sim/policies/policy.h"

namespace throng::sim {

/// Adds to `problems`; `pointer` is the JSON pointer of the drone's "guidance".
void check_guidance(const PolicyEntry& policy, const DroneMission& mission,
                    const world::Scenario& scenario, const std::string& pointer,
                    std::vector<Problem>& problems);

}  // namespace throng::sim
