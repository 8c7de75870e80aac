// The crowd of a scenario, whether it is in files or in memory.
#pragma once

#include "crowd/description/description.h"
#include "world/scenario.h"

namespace throng::world {

/// Scene and behavior of a scenario. Throws InputError when it has no crowd or a file is not XML,
/// EnvironmentError when one cannot be read.
crowd::CrowdDescription build_crowd(const Scenario& scenario);

}  // namespace throng::world
