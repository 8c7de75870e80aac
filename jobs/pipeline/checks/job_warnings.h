// Warnings about jobs that can run, but whose result is probably not intended.
#pragma once

#include <vector>

#include "base/error.h"
#include "jobs/pipeline/checks/view_check.h"
#include "spec/job/spec.h"
#include "world/scenario.h"

namespace throng::jobs {

/// Warnings about settings without effect: rain in dry weather, kinds of ground truth that are part
/// of the COCO file if that is not requested, splits and scenarios without runs. `where` has JSON
/// pointers; `source` is empty.
std::vector<Problem> warnings_of_settings(const JobSpec& job);

/// Warnings about a job in one of its scenarios: smoke without hazards, drones far away, and
/// cameras that show nobody, or only people of a few pixels, in all images. Checks a few runs from
/// `first_run` on.
std::vector<Problem> scenario_warnings(const JobSpec& job, const world::Scenario& scenario,
                                       const StartingCrowd& crowd, int first_run);

}  // namespace throng::jobs
