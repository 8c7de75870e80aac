// Fields of the people of a blueprint and of its disasters.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "base/json/field_table.h"
#include "spec/blueprint/people.h"

namespace throng::scenarios {

/// The fields of "people". The exits of sources are read as ids.
const fields::FieldTable<People>& people_fields();

/// The rules of the list "disasters" of a blueprint.
fields::Values danger_lists();

/// Reads "disasters"; each stands for the agent of its index. Adds a problem if it is no list.
std::vector<Danger> read_dangers(const nlohmann::json& list, const fields::FieldLocation& place);

}  // namespace throng::scenarios
