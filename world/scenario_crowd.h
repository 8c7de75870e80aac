// The crowd of a scenario, from files or from memory.
#pragma once

#include "crowd/description/description.h"
#include "world/scenario.h"

namespace throng::world {

/// Returns the scene and behavior of a scenario. Throws InputError if it has no crowd or a file is
/// not XML, EnvironmentError if a file cannot be read.
crowd::CrowdDescription build_crowd(const Scenario& scenario);

}  // namespace throng::world
