// The state machine of a blueprint's people.
#pragma once

#include <string>

#include "crowd/description/description.h"
#include "world/scenarios/blueprint/people.h"

namespace throng::scenarios {

/// The state in which people begin who do this.
std::string state_name(Doing doing);
/// The state of people who come in order to go to this exit.
std::string state_towards(const world::Exit& exit);

/// The behavior: everyday states, and where there are disasters: noticing, time to react, flight,
/// following a drone.
crowd::BehaviorDescription describe_behavior(const world::Scenario& scenario, const People& people);

}  // namespace throng::scenarios
