#include "jobs/pipeline/checks/checked_scenario.h"

#include <utility>

#include "base/error.h"
#include "jobs/pipeline/runs/run_input.h"
#include "sim/planning/aimed_start.h"
#include "sim/run.h"
#include "spec/job/plan.h"

namespace throng::jobs {

CheckedScenario::CheckedScenario(JobSpec job, world::Scenario scenario, std::vector<int> runs)
    : job_(std::move(job)), scenario_(std::move(scenario)), runs_(std::move(runs)) {}

bool CheckedScenario::is_of_trace() const {
  return !scenario_.has_crowd() && scenario_.alarm.has_value();
}

const crowd::Simulation& CheckedScenario::people() {
  if (!people_) {
    const int run = runs_.front();
    people_ = sim::load_people(scenario_, run_seed(job_, run), job_of_run(job_, run).crowd);
  }
  return *people_;
}

crowd::Simulation CheckedScenario::take_people() {
  static_cast<void>(people());
  crowd::Simulation taken = *std::move(people_);
  people_.reset();
  return taken;
}

const std::vector<Eigen::Vector2d>& CheckedScenario::people_to_aim_at() {
  if (aimed_at_) return *aimed_at_;
  aimed_at_.emplace();
  try {
    const sim::RunSpec run = run_spec(job_, runs_.front());
    if (!sim::has_aims(run) || is_of_trace()) return *aimed_at_;
    aimed_at_ = run.recorded ? sim::people_to_aim_at(scenario_, run)
                             : sim::people_to_aim_at(scenario_, run, people());
  } catch (const InputError&) {
  } catch (const EnvironmentError&) {
  }
  return *aimed_at_;
}

}  // namespace throng::jobs
