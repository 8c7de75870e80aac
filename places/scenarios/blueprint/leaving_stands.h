// Spectators who leave their stands, as people of a blueprint.
#pragma once

#include "base/json/field_table.h"
#include "spec/blueprint/people.h"
#include "world/scenario.h"

namespace throng::scenarios {

/// Whether spectators of the scenario leave.
bool anybody_leaves_stands(const world::Scenario& scenario);

/// Adds a source for each foot of an aisle by which spectators leave, in the order of stands and
/// world::departures(), after all others: there they arrive, and leave by the exits. Adds a problem
/// for each stand of which an aisle does not end on free ground inside. `place` is the blueprint.
void add_leaving_spectators(const world::Scenario& scenario, const fields::FieldLocation& place,
                            People& people);

}  // namespace throng::scenarios
