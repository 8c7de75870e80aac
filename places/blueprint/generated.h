// Generated places as scenarios, without anybody having to keep their files.
#pragma once

#include <vector>

#include "base/error.h"
#include "places/blueprint/generate.h"
#include "world/scenario.h"

namespace throng::places {

/// Problems of a generated blueprint with pointers into the spec that it was made from ("/people"),
/// and without a source.
std::vector<Problem> problems_of_spec(std::vector<Problem> problems);

/// The scenario of a spec; its id is scenario_id_of(spec). Nothing is written: its crowd is
/// Scenario::built_crowd. Throws InputError with pointers into the spec.
world::Scenario load_generated(const PlaceSpec& spec);

}  // namespace throng::places
