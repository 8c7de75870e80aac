// The crowd of a blueprint's people.
#pragma once

#include <vector>

#include "base/error.h"
#include "crowd/description/description.h"
#include "places/scenarios/blueprint/standing.h"
#include "spec/blueprint/people.h"

namespace throng::scenarios {

/// Describes the crowd. Adds a problem for each group that has no room for all of its people.
crowd::CrowdDescription crowd_of_people(const world::Scenario& scenario, const People& people,
                                        std::vector<Problem>& problems);

}  // namespace throng::scenarios
