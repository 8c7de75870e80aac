// Summary of a scenario for the service's list of scenarios.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "world/scenario.h"

namespace throng::jobs {

/// Name, description, crowd model, extent of the ground, exits, drones' starts, and the numbers of
/// buildings and props. The caller adds the id, which depends on the scenario's location. Throws
/// InputError if it is larger than 32 KiB: a list holds those of all scenarios.
nlohmann::json scenario_summary(const world::Scenario& scenario);

}  // namespace throng::jobs
