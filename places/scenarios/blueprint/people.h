// Reads the people of a blueprint, and finds their exits.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "base/json/field_table.h"
#include "spec/blueprint/people.h"
#include "world/scenario.h"

namespace throng::scenarios {

/// Whether anybody leaves by an exit independently of disasters.
bool anybody_leaves(const People& people);

/// Reads "people" and "disasters" of a blueprint with the exits of this scenario. `place` is the
/// position of the blueprint; problems go to its list.
People read_people(const nlohmann::json& blueprint, const world::Scenario& scenario,
                   const fields::FieldLocation& place);

}  // namespace throng::scenarios
