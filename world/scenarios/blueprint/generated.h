// Generated places as scenarios, without anybody having to keep their files.
#pragma once

#include <vector>

#include "base/error.h"
#include "world/scenario.h"
#include "world/scenarios/blueprint/generate.h"

namespace throng::scenarios {

/// Problems of a generated blueprint with pointers into the spec that it was made from ("/people"),
/// and without a source.
std::vector<Problem> problems_of_spec(std::vector<Problem> problems);

/// The scenario of a spec; its id is generated_scenario_id(spec). Nothing is written: its crowd is
/// Scenario::built_crowd. Throws InputError with pointers into the spec.
world::Scenario load_generated(const GeneratorSpec& spec);

}  // namespace throng::scenarios
