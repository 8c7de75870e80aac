#include "jobs/pipeline/runs/job_scenario.h"

#include <utility>
#include <vector>

#include "base/error.h"
#include "places/scenarios/blueprint/generated.h"
#include "places/scenarios/blueprint/load_scenario.h"
#include "world/fields/trace_scenario.h"

namespace throng::jobs {

world::Scenario load_job_scenario(const JobSpec& job, const std::filesystem::path& scenarios,
                                  const std::string& source, const std::string& pointer) {
  try {
    return job.generate ? scenarios::load_generated(*job.generate)
                        : scenarios::find_scenario(scenarios, job.scenario);
  } catch (const InputError& error) {
    std::vector<Problem> problems = error.problems();
    for (Problem& problem : problems) {
      if (!problem.source.empty()) continue;
      problem.source = source;
      problem.where = job.generate ? pointer + "/generate" + problem.where : pointer;
    }
    throw InputError(std::move(problems));
  }
}

world::Scenario scenario_of_run(const JobSpec& job, const std::filesystem::path& scenarios,
                                const world::TraceHeader& header) {
  auto kept = world::scenario_in_trace(header, "trace.h5", world::TraceMeshes::needed);
  return kept ? *std::move(kept) : load_job_scenario(job, scenarios);
}

}  // namespace throng::jobs
