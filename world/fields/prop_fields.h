// Fields of props.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "base/json/field_table.h"
#include "world/scenario.h"

namespace throng::world {

/// The kinds of props, and how much larger or smaller than usual they may be.
fields::Values prop_kinds();
fields::Values prop_scales();

/// The fields of a prop.
const fields::FieldTable<Prop>& prop_fields();

/// Rules of the list "scatter" of a scenario.
fields::Values scatter_lists();

/// Sets the looks of props that were read without one. A prop in a building or within
/// kClearOfExitsM of an exit, which are already read, is a problem.
void check_props(Scenario& scenario, const nlohmann::json& list,
                 const fields::FieldLocation& place);

/// Reads the list "scatter" and adds its props, which avoid buildings, exits and each other, to
/// those of a scenario whose exits, buildings and placed props are already read.
void scatter_props(Scenario& scenario, const nlohmann::json& list,
                   const fields::FieldLocation& place);

/// Rules of a scenario's "clutter".
fields::Values clutter_values();

/// Reads "clutter" and strews it over a scenario whose other parts are already read.
void strew_clutter(Scenario& scenario, const nlohmann::json& value,
                   const fields::FieldLocation& place);

/// Rules of a scenario's "sitters".
fields::Values sitter_values();

/// Reads "sitters" and seats people on the props of a scenario whose other parts are already read.
void read_sitters(Scenario& scenario, const nlohmann::json& value,
                  const fields::FieldLocation& place);

}  // namespace throng::world
