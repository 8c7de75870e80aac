#include "jobs/spec/job_scenario.h"

#include "places/generated.h"

namespace throng::jobs {

world::Scenario scenario_of(const JobSpec& job, const std::filesystem::path& scenarios) {
  if (job.generate) return places::load_generated(*job.generate);
  return world::find_scenario(scenarios, job.scenario);
}

}  // namespace throng::jobs
