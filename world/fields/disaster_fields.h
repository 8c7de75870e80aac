// Fields of disasters.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "base/json/field_table.h"
#include "world/disasters.h"

namespace throng::world {

/// The fields that scenarios and blueprints give a disaster: all but the agent. A missing
/// "max_radius_m" means 1000 m: see begin_disaster().
const fields::FieldTable<Disaster>& disaster_fields();

/// A disaster with the defaults of disaster_fields().
Disaster begin_disaster();

/// Rules of the list "disasters" of a scenario.
fields::Values disaster_lists();

/// Reads the list "disasters" of a scenario, whose agents must differ.
std::vector<Disaster> read_disasters(const nlohmann::json& list,
                                     const fields::FieldLocation& place);

}  // namespace throng::world
