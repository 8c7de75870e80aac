// A scenario as clients see it in a list.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "world/scenario.h"

namespace throng::jobs {

/// Name, description, exits, drones and sizes; without its id, which depends on where it lies.
nlohmann::json scenario_summary(const world::Scenario& scenario);

}  // namespace throng::jobs
