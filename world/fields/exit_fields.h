// Fields of a scenario's exits, and their rules.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "base/geometry/region.h"
#include "base/json/field_table.h"
#include "world/scenario.h"

namespace throng::world {

/// Rules of the list "exits" of a scenario.
fields::Values exit_lists();

/// Reads the list of exits. The outward side of an exit is that which the file gives, or that which
/// leads out of the polygon on whose border the exit lies, or that away from the middle of
/// `inside`.
std::vector<Exit> read_exits(const nlohmann::json& list, const geometry::Region& inside,
                             const fields::FieldLocation& place);

}  // namespace throng::world
