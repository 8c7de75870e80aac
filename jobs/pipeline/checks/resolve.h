// From what a job says to a job that can be run: its files are read, and it is checked against its
// scenario: lenses, drones, people, formats. Done once per job; workers do not repeat it.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "spec/job/resolved_job.h"
#include "world/scenario.h"

namespace throng::jobs {

/// Resolves a job in its scenario. Loads the scenario's crowd if the job says how many people take
/// part. Throws InputError with all problems (JSON pointers into `source`, the job's file or "").
ResolvedJob resolve(JobSpec job, const world::Scenario& scenario, const std::string& source);

/// Drones of a job that names none.
enum class DefaultDrones {
  of_scenario,  ///< those of the scenario; without any the job is one for figures
  none          ///< nobody flies, and nothing is rendered
};

/// Parses a job's text, loads its scenario from the folder `scenarios` and resolves it. All
/// problems are reported together: where the text breaks the schema, the rest of it is checked,
/// too.
ResolvedJob resolve_job(std::string_view json, const std::string& source,
                        const std::filesystem::path& scenarios,
                        DefaultDrones default_drones = DefaultDrones::of_scenario);

}  // namespace throng::jobs
