// Fields of a scenario's exits and doors inside, and their rules.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "base/json/field_table.h"
#include "world/scenario.h"

namespace throng::world {

/// The fields of an exit. The outward vector is that of the file until check_exits().
const fields::FieldTable<Exit>& exit_fields();

/// Checks the exits that were read and sets their outward sides: that which the file gives, or that
/// which leads out of the polygon on whose border the exit lies, or that away from the middle of
/// Scenario::inside.
void check_exits(Scenario& scenario, const nlohmann::json& list,
                 const fields::FieldLocation& place);

/// The fields of a door inside.
const fields::FieldTable<InnerDoor>& inner_door_fields();

/// Checks the doors inside that were read.
void check_inner_doors(Scenario& scenario, const nlohmann::json& list,
                       const fields::FieldLocation& place);

}  // namespace throng::world
