#include "sim/policy.h"

#include <algorithm>
#include <array>

#include "sim/hover_policy.h"
#include "sim/waypoints_policy.h"

namespace throng::sim {

namespace {

constexpr std::array kPolicies{
    PolicyEntry{"hover", false, &make_hover_policy},
    PolicyEntry{"waypoints", true, &make_waypoints_policy},
};

}  // namespace

std::span<const PolicyEntry> policies() { return kPolicies; }

const PolicyEntry* find_policy(std::string_view name) {
  const auto* found = std::find_if(kPolicies.begin(), kPolicies.end(),
                                   [&](const PolicyEntry& entry) { return entry.name == name; });
  return found == kPolicies.end() ? nullptr : found;
}

}  // namespace throng::sim
