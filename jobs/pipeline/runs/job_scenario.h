// The scenario of a job.
#pragma once

#include <filesystem>
#include <string>

#include "spec/job/spec.h"
#include "world/scenario.h"
#include "world/trace.h"

namespace throng::jobs {

/// Loads the scenario that the job names from the folder `scenarios`, or generates the one that the
/// job describes. For a job with several scenarios, pass the result of in_scenario_of_run()
/// (spec/job/scenario_mix.h). Throws InputError: at `pointer` in `source` (the job's file or "") if
/// the scenario does not exist or cannot be generated, at the scenario's file if that is wrong.
world::Scenario load_job_scenario(const JobSpec& job, const std::filesystem::path& scenarios,
                                  const std::string& source = "",
                                  const std::string& pointer = "/scenario");

/// The scenario of a simulated run: the one in its trace if there is one, else the job's.
world::Scenario scenario_of_run(const JobSpec& job, const std::filesystem::path& scenarios,
                                const world::TraceHeader& header);

}  // namespace throng::jobs
