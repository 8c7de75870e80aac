// The state machine of a blueprint's people.
#pragma once

#include <string>

#include "crowd/description/description.h"
#include "places/blueprint/people.h"

namespace throng::places {

/// The state in which people begin who do this.
std::string state_of(Doing doing);
/// The state of people who come in order to go to this exit.
std::string state_towards(const world::Exit& exit);

/// The behavior: everyday states, and where there are disasters: noticing, time to react, flight,
/// following a drone.
crowd::BehaviorDescription behavior_of(const world::Scenario& scenario, const People& people);

}  // namespace throng::places
