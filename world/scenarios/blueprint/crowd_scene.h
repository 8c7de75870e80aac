// The crowd of a blueprint's people.
#pragma once

#include <vector>

#include "base/error.h"
#include "crowd/description/description.h"
#include "world/scenarios/blueprint/people.h"
#include "world/scenarios/blueprint/standing.h"

namespace throng::scenarios {

/// An exit's goals in the behavior: for those who leave as always, and for those who flee.
inline constexpr int kLeavingSet = 5;
inline constexpr int kFleeingSet = 3;
inline constexpr int kGuidesSet = 99;

/// Describes the crowd. Adds to `problems` where people find no room.
crowd::CrowdDescription crowd_of_people(const world::Scenario& scenario, const People& people,
                                        std::vector<Problem>& problems);

}  // namespace throng::scenarios
