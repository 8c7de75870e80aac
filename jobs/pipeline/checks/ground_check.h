// Checks of a job's outputs on the ground: cell sizes of fields, counting zones and lines.
#pragma once

#include <vector>

#include "base/error.h"
#include "spec/job/spec.h"
#include "world/scenario.h"

namespace throng::jobs {

/// Adds a problem for areas and cell sizes whose kind of ground truth the job does not request, for
/// areas with the name of an exit or another area, and for cells finer than those of the scenario's
/// fields.
void check_ground_outputs(const OutputSpec& outputs, const std::vector<world::Scenario>& scenarios,
                          std::vector<Problem>& problems);

}  // namespace throng::jobs
