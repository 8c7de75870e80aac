// Warnings: jobs that can run, but whose result is probably not what was meant.
#pragma once

#include <vector>

#include "base/error.h"
#include "jobs/pipeline/checks/view_check.h"
#include "spec/job/spec.h"
#include "world/scenario.h"

namespace throng::jobs {

/// Settings without effect: rain in dry weather, ground truth that is part of a kind that is not
/// asked for, splits and scenarios without runs. JSON pointers in `where`, no source.
std::vector<Problem> warnings_of_settings(const JobSpec& job);

/// A job in one of its scenarios: smoke without hazards, drones far away, and cameras that show
/// nobody, or people of a few pixels, in any image. Looks at a few runs from `first_run` on.
std::vector<Problem> scenario_warnings(const JobSpec& job, const world::Scenario& scenario,
                                       const StartingCrowd& crowd, int first_run);

}  // namespace throng::jobs
