// Fields of disasters.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "base/json/field_table.h"
#include "world/scenario.h"

namespace throng::world {

/// The fields that scenarios and blueprints give a disaster: all but the agent.
const fields::FieldTable<Disaster>& disaster_fields();

/// The fields of an item of the list "disasters" of a scenario.
const fields::FieldTable<Disaster>& listed_disaster_fields();

/// Adds a problem for each disaster with the agent of another one.
void check_disaster_agents(Scenario& scenario, const nlohmann::json& list,
                           const fields::FieldLocation& place);

}  // namespace throng::world
