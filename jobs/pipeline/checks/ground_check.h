// Checks of what a job wants counted on the ground: cells of fields, zones and lines.
#pragma once

#include <vector>

#include "base/error.h"
#include "spec/job/spec.h"
#include "world/scenario.h"

namespace throng::jobs {

/// Adds a problem for areas and cells whose annotation the job does not have, for names that an
/// exit or another area has, and for cells finer than those of the scenario's fields.
void check_ground_outputs(const OutputSpec& outputs, const std::vector<world::Scenario>& scenarios,
                          std::vector<Problem>& problems);

}  // namespace throng::jobs
