// Resolution of a job: reads the files that it names and checks it against its scenario (lenses,
// drones, people, formats). Done once per job; workers do not repeat it.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "jobs/pipeline/checks/checked_scenario.h"
#include "spec/job/resolved_job.h"
#include "world/scenario.h"

namespace throng::jobs {

/// Resolves a job in its scenario. Loads the scenario's crowd if the job sets the number of people.
/// Throws InputError with all problems; their JSON pointers lead into `source`, the job's file or
/// "".
ResolvedJob resolve(JobSpec job, const world::Scenario& scenario, const std::string& source);

/// Drones of a job that does not list any.
enum class DefaultDrones {
  of_scenario,  ///< those of the scenario; if it has none, the job renders nothing
  none          ///< no drones: the job renders nothing
};

/// A resolved job and its scenarios, in the order of first_runs().
struct Resolution {
  ResolvedJob job;
  std::vector<CheckedScenario> scenarios;
};

/// Reads a job's document, loads its scenarios from the folder `scenarios` and resolves it. Throws
/// InputError with all problems together: parts of the document that obey the schema are checked
/// even if others break it.
Resolution resolve_in_scenarios(const nlohmann::json& document, const std::string& source,
                                const std::filesystem::path& scenarios,
                                DefaultDrones default_drones = DefaultDrones::of_scenario);
ResolvedJob resolve_job(const nlohmann::json& document, const std::string& source,
                        const std::filesystem::path& scenarios,
                        DefaultDrones default_drones = DefaultDrones::of_scenario);
/// The same for a document that obeys the schema, which is not checked again.
ResolvedJob resolve_valid_job(const nlohmann::json& document, const std::string& source,
                              const std::filesystem::path& scenarios);

}  // namespace throng::jobs
