// Places from a seed: blueprints that are always valid.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "spec/scenarios/generator_spec.h"

namespace throng::scenarios {

/// The blueprint of such a scenario: every walkable point reaches an exit, nobody starts in
/// anything solid and people come in by every exit. The same spec gives the same blueprint.
nlohmann::json generate_blueprint(const GeneratorSpec& spec);

}  // namespace throng::scenarios
