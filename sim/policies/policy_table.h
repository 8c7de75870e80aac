// The table of policies.
#pragma once

#include <span>
#include <string_view>

#include "sim/policies/policy.h"

namespace throng::sim {

/// All policies.
std::span<const PolicyEntry> policies();

/// Returns the policy with this name, or null.
const PolicyEntry* find_policy(std::string_view name);

}  // namespace throng::sim
