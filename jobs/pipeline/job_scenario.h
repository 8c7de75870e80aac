// The scenario of a job.
#pragma once

#include <filesystem>
#include <string>

#include "spec/job/spec.h"
#include "world/scenario.h"
#include "world/trace.h"

namespace throng::jobs {

/// The scenario that the job names, or the one that is generated for it; of a job of several, that
/// of in_scenario_of_run() (spec/job/scenario_mix.h). Throws InputError: at `pointer` of `source`,
/// the job's file or "", if there is none of the name or none can be generated; a broken scenario
/// file names itself.
world::Scenario load_job_scenario(const JobSpec& job, const std::filesystem::path& scenarios,
                                  const std::string& source = "",
                                  const std::string& pointer = "/scenario");

/// The scenario of a run that was simulated: as its trace holds it, else the job's.
world::Scenario scenario_of_run(const JobSpec& job, const std::filesystem::path& scenarios,
                                const world::TraceHeader& header);

}  // namespace throng::jobs
