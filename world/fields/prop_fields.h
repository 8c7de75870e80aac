// Fields of props.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "base/json/field_table.h"
#include "world/props.h"

namespace throng::world {

/// The kinds of props, and how much larger or smaller than usual they may be.
fields::Values prop_kinds();
fields::Values prop_scales();

/// Rules of the lists "props" and "scatter" of a scenario.
fields::Values prop_lists();
fields::Values scatter_lists();

/// Reads the list "props" of a scenario whose exits and buildings are already read. A prop in a
/// building or within kClearOfExitsM of an exit is a problem.
std::vector<Prop> read_props(const nlohmann::json& list, const Scenario& scenario,
                             const fields::FieldLocation& place);

/// Reads the list "scatter" and adds its props, which avoid buildings, exits and each other, to
/// those of a scenario whose exits, buildings and placed props are already read.
void scatter_props(const nlohmann::json& list, Scenario& scenario,
                   const fields::FieldLocation& place);

}  // namespace throng::world
