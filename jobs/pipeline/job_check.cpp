#include "jobs/pipeline/job_check.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <utility>

#include "jobs/pipeline/job_scenario.h"
#include "jobs/pipeline/job_warnings.h"
#include "jobs/pipeline/recording.h"
#include "jobs/pipeline/resolve.h"
#include "jobs/spec/plan.h"
#include "jobs/spec/schema_problems.h"
#include "jobs/spec/spec.h"
#include "sim/run.h"

namespace throng::jobs {

namespace {

constexpr double kRecordedSpeedMps = 2;
constexpr std::size_t kRecordedSteps = 200;  // that are looked at, evenly spread

StartingCrowd recorded_crowd(const world::Trace& recording) {
  StartingCrowd crowd{.max_speed_mps = kRecordedSpeedMps};
  const std::size_t stride = std::max<std::size_t>(1, recording.steps() / kRecordedSteps);
  for (std::size_t step = 0; step < recording.steps(); step += stride) {
    for (std::size_t agent = 0; agent < recording.agents(); ++agent) {
      if (!recording.present(step, agent)) continue;
      crowd.places.push_back(recording.position[recording.at(step, agent)].cast<double>());
    }
  }
  return crowd;
}

StartingCrowd starting_crowd(const JobSpec& job, const crowd::Simulation& simulation,
                             const std::set<int>& hazards) {
  StartingCrowd crowd;
  if (job.agents == 0) return crowd;
  for (std::size_t agent = 0; agent < simulation.agent_count(); ++agent) {
    if (hazards.contains(static_cast<int>(agent))) continue;
    crowd.max_speed_mps =
        std::max<double>(crowd.max_speed_mps, simulation.desired_speeds_mps()[agent]);
    if (simulation.present()[agent] == 0) {
      crowd.has_arrivals = true;
    } else {
      crowd.places.push_back(simulation.positions()[agent].cast<double>());
    }
  }
  // Nobody wants to walk before the first step.
  constexpr double kUsualSpeedMps = 1.4;
  crowd.max_speed_mps = std::max(crowd.max_speed_mps, kUsualSpeedMps);
  return crowd;
}

}  // namespace

CheckedJob check_job(std::string_view text, const std::string& source,
                     const std::filesystem::path& scenarios) {
  CheckedJob checked{resolve_job(text, source, scenarios)};
  const JobSpec& job = checked.job.spec();
  const world::Scenario scenario = scenario_of(job, scenarios, source);
  StartingCrowd crowd;
  if (job.recorded) {
    const world::Trace recording = read_recording(*job.recorded);
    checked.people = static_cast<std::int64_t>(recording.agents());
    crowd = recorded_crowd(recording);
  } else {
    const std::set<int> hazards(scenario.disaster_agents.begin(), scenario.disaster_agents.end());
    const crowd::Simulation simulation =
        sim::load_crowd(scenario, plan_runs(job).front().seed, job.crowd);
    checked.people = static_cast<std::int64_t>(simulation.agent_count() - hazards.size());
    crowd = starting_crowd(job, simulation, hazards);
  }
  if (job.agents) checked.people = *job.agents;
  checked.cost = estimate_cost(job, checked.people);
  checked.warnings = deprecated_fields(text);
  const std::vector<Problem> settings = warnings_of_settings(job, scenario);
  checked.warnings.insert(checked.warnings.end(), settings.begin(), settings.end());
  for (std::optional<CameraView>& view : views_of_run(job, scenario, crowd, 0)) {
    if (view) checked.views.push_back(std::move(*view));
  }
  const std::vector<Problem> more = warnings_of_views(job, scenario, crowd);
  checked.warnings.insert(checked.warnings.end(), more.begin(), more.end());
  for (Problem& warning : checked.warnings) warning.source = source;
  return checked;
}

nlohmann::json to_json(const CheckedJob& checked) {
  nlohmann::json views = nlohmann::json::array();
  for (const CameraView& view : checked.views) views.push_back(to_json(view));
  nlohmann::json warnings = nlohmann::json::array();
  for (const Problem& warning : checked.warnings) {
    warnings.push_back(
        {{"pointer", warning.where},
         {"found", warning.found},
         {"expected", warning.expected},
         {"message", Problem{"", warning.where, warning.found, warning.expected}.text()}});
  }
  return {{"runs", checked.cost.runs},
          {"shards", checked.cost.shards},
          {"frames", checked.cost.images},
          {"people", checked.people},
          {"estimate", estimate_json(checked.cost)},
          {"views", std::move(views)},
          {"warnings", std::move(warnings)},
          {"job", to_json(checked.job.spec())}};
}

}  // namespace throng::jobs
