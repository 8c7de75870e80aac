// Generated scenarios in memory, without files.
#pragma once

#include <vector>

#include "base/error.h"
#include "places/scenarios/blueprint/generate.h"
#include "world/scenario.h"

namespace throng::scenarios {

/// The problems of a generated blueprint with JSON pointers into its spec ("/people") and without a
/// source.
std::vector<Problem> problems_of_spec(std::vector<Problem> problems);

/// Generates the scenario of a spec, with the id generated_scenario_id(spec). Writes no files; the
/// crowd is Scenario::built_crowd. Throws InputError with JSON pointers into the spec.
world::Scenario load_generated(const GeneratorSpec& spec);

}  // namespace throng::scenarios
