// Warnings: jobs that can run, but whose result is probably not what was meant.
#pragma once

#include <vector>

#include "base/error.h"
#include "jobs/pipeline/view_check.h"
#include "jobs/spec/spec.h"
#include "world/scenario.h"

namespace throng::jobs {

/// Settings without effect: rain in dry weather, smoke without hazards, ground truth that is part
/// of a kind that is not asked for, splits without runs. JSON pointers in `where`, no source.
std::vector<Problem> warnings_of_settings(const JobSpec& job, const world::Scenario& scenario);

/// Drones far from the scenario, and cameras that show nobody, or people of a few pixels, in any
/// image. Looks at the first few runs.
std::vector<Problem> warnings_of_views(const JobSpec& job, const world::Scenario& scenario,
                                       const StartingCrowd& crowd);

}  // namespace throng::jobs
