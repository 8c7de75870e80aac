// The state machine of a blueprint's people.
#pragma once

#include <string>
#include <vector>

#include "crowd/description/description.h"
#include "places/scenarios/blueprint/closing_doors.h"
#include "spec/blueprint/people.h"

namespace throng::scenarios {

/// Ids of goal sets in the behavior: the exits for people who leave normally, the exits for people
/// who flee, and the goals that drones move.
inline constexpr int kLeavingSet = 5;
inline constexpr int kFleeingSet = 3;
inline constexpr int kGuidesSet = 99;

/// Name of the initial state of people with this activity.
std::string state_name(Doing doing);
/// Name of the initial state of people who arrive and head for this exit.
std::string state_towards(const world::Exit& exit);

/// Describes the behavior: states of everyday activities and, with disasters, of noticing,
/// pre-movement, flight and following a drone.
crowd::BehaviorDescription describe_behavior(const world::Scenario& scenario, const People& people,
                                             const std::vector<ClosingDoor>& doors);

}  // namespace throng::scenarios
