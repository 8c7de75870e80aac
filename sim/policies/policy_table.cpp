#include "sim/policies/policy_table.h"

#include <algorithm>
#include <array>

#include "sim/policies/balance_policy.h"
#include "sim/policies/follow_density_policy.h"
#include "sim/policies/hover_policy.h"
#include "sim/policies/orbit_policy.h"
#include "sim/policies/pilot_log_policy.h"
#include "sim/policies/signage_policy.h"
#include "sim/policies/survey_policy.h"
#include "sim/policies/waypoints_policy.h"
#include "sim/policies/zigzag_policy.h"

namespace throng::sim {

namespace {

constexpr std::array kPolicies{
    PolicyEntry{"hover", 0, kFieldBeacon, false, &make_hover_policy},
    PolicyEntry{"waypoints", kFieldWaypoints, kFieldBeacon, false, &make_waypoints_policy},
    PolicyEntry{"orbit", kFieldCenter | kFieldRadius, kFieldBeacon, true, &make_orbit_policy},
    PolicyEntry{"survey", 0, kFieldArea | kFieldOverlap | kFieldBeacon, true, &make_survey_policy},
    PolicyEntry{"follow_density", 0, kFieldPerception | kFieldBeacon, true,
                &make_follow_density_policy},
    PolicyEntry{"pilot_log", kFieldSetpoints, 0, false, &make_pilot_log_policy},
    PolicyEntry{"signage", 0, kFieldExits | kFieldPerception, true, &make_signage_policy},
    PolicyEntry{"zigzag", 0, kFieldExits | kFieldPerception, true, &make_zigzag_policy},
    PolicyEntry{"balance", 0, kFieldExits | kFieldLeadSpeed | kFieldBatch | kFieldPerception, true,
                &make_balance_policy},
};

}  // namespace

std::span<const PolicyEntry> policies() { return kPolicies; }

const PolicyEntry* find_policy(std::string_view name) {
  const auto* found = std::find_if(kPolicies.begin(), kPolicies.end(),
                                   [&](const PolicyEntry& entry) { return entry.name == name; });
  return found == kPolicies.end() ? nullptr : found;
}

}  // namespace throng::sim
