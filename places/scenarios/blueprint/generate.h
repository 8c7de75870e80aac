// Generation of blueprints from a seed.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "spec/scenarios/generator_spec.h"

namespace throng::scenarios {

/// Generates a valid blueprint: an exit is reachable from every walkable point, nobody starts in an
/// obstacle, and people enter by every exit. Equal specs give equal blueprints.
nlohmann::json generate_blueprint(const GeneratorSpec& spec);

}  // namespace throng::scenarios
