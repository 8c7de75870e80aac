// The policies, by name.
#pragma once

#include <span>
#include <string_view>

#include "sim/policies/policy.h"

namespace throng::sim {

/// Every policy there is.
std::span<const PolicyEntry> policies();

/// The policy of that name; null when there is none.
const PolicyEntry* find_policy(std::string_view name);

}  // namespace throng::sim
