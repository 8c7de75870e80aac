#include "jobs/pipeline/checks/job_check.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <utility>

#include "jobs/pipeline/checks/job_warnings.h"
#include "jobs/pipeline/checks/rehearsal.h"
#include "jobs/pipeline/checks/resolve.h"
#include "jobs/pipeline/runs/job_scenario.h"
#include "jobs/pipeline/runs/recording.h"
#include "sim/run.h"
#include "spec/job/plan.h"
#include "spec/job/scenario_mix.h"
#include "spec/job/schema_problems.h"
#include "spec/job/spec.h"

namespace throng::jobs {

namespace {

constexpr double kRecordedSpeedMps = 2;
constexpr std::size_t kRecordedSteps = 200;  // that are looked at, evenly spread

/// The steps of a recording that a run shows, which ends at `end_s`.
std::size_t shown_steps(const world::Trace& recording, double end_s) {
  const auto after = std::upper_bound(recording.time_s.begin(), recording.time_s.end(),
                                      end_s + world::kTimeSlackS);
  return std::max<std::size_t>(1, static_cast<std::size_t>(after - recording.time_s.begin()));
}

double count_shown_people(const world::Trace& recording, std::size_t steps) {
  double count = 0;
  for (std::size_t agent = 0; agent < recording.agents(); ++agent) {
    std::size_t step = 0;
    while (step < steps && !recording.present(step, agent)) ++step;
    count += step < steps ? 1 : 0;
  }
  return count;
}

StartingCrowd recorded_crowd(const world::Trace& recording, std::size_t steps) {
  StartingCrowd crowd{.max_speed_mps = kRecordedSpeedMps};
  const std::size_t stride = std::max<std::size_t>(1, steps / kRecordedSteps);
  crowd.times = 0;
  for (std::size_t step = 0; step < steps; step += stride) {
    ++crowd.times;
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

/// A job in one of its scenarios.
struct ScenarioCheck {
  ExpectedRun expected;
  std::vector<CameraView> views;
  std::vector<Problem> warnings;
};

/// People who come before the end of a run.
struct ExpectedArrivals {
  double people = 0;
  double at_a_time = 0;  ///< mean number of them who are present, as if nobody left
};

ExpectedArrivals expected_arrivals(const crowd::Simulation& simulation, double duration_s) {
  ExpectedArrivals expected;
  for (const double time_s : simulation.planned_arrivals_s()) {
    if (time_s >= duration_s) continue;
    ++expected.people;
    expected.at_a_time += 1 - time_s / duration_s;
  }
  return expected;
}

ScenarioCheck check_scenario(CheckedScenario& place) {
  const JobSpec& job = place.job();
  const world::Scenario& scenario = place.scenario();
  const int run = place.runs().front();
  ScenarioCheck checked;
  StartingCrowd crowd;
  double shown_people = 0;  // of a recording
  ExpectedArrivals arrivals;
  if (job.recorded) {
    std::vector<Problem> notes;
    const world::Trace recording = read_recording(*job.recorded, &notes);
    const std::size_t steps = shown_steps(recording, job.capture.end_s());
    checked.expected.people = static_cast<std::int64_t>(recording.agents());
    shown_people = count_shown_people(recording, steps);
    crowd = recorded_crowd(recording, steps);
    checked.warnings = recording_warnings(std::move(notes), recording, scenario);
  } else {
    const std::set<int> hazards(scenario.disaster_agents.begin(), scenario.disaster_agents.end());
    const crowd::Simulation& simulation = place.people();
    checked.expected.people = static_cast<std::int64_t>(simulation.agent_count() - hazards.size());
    crowd = starting_crowd(job, simulation, hazards);
    arrivals = expected_arrivals(simulation, job.capture.end_s());
  }
  crowd.aimed_at = place.people_to_aim_at();
  const world::Rectangle& ground = scenario.ground;
  checked.expected.ground_m2 = (ground.max - ground.min).prod();
  checked.expected.is_fled = !scenario.disasters.empty();
  // People who take part are drawn from all with equal chances.
  const auto all = static_cast<double>(std::max<std::int64_t>(1, checked.expected.people));
  if (job.agents) checked.expected.people = *job.agents;
  const double taking_part = static_cast<double>(checked.expected.people) / all;
  const auto places = static_cast<double>(crowd.places.size());
  const double at_start =
      taking_part * places / static_cast<double>(std::max<std::size_t>(1, crowd.times));
  checked.expected.taking_part =
      job.recorded ? taking_part * shown_people : at_start + taking_part * arrivals.people;
  // Others leave meanwhile.
  constexpr double kShareThere = 0.9;
  checked.expected.at_a_time = at_start + kShareThere * taking_part * arrivals.at_a_time;
  const double scale = checked.expected.at_a_time / std::max(1.0, places);
  for (std::optional<CameraView>& view : views_of_run(job, scenario, crowd, run)) {
    checked.expected.in_view.push_back(view ? std::optional(scale * view->mean_people)
                                            : std::nullopt);
    if (view) checked.views.push_back(std::move(*view));
  }
  for (Problem& warning : scenario_warnings(job, scenario, crowd, run)) {
    checked.warnings.push_back(std::move(warning));
  }
  for (Problem& warning : scenario_findings(scenario))
    checked.warnings.push_back(std::move(warning));
  for (Problem& warning : rehearse(place, checked.expected.people)) {
    checked.warnings.push_back(std::move(warning));
  }
  return checked;
}

}  // namespace

CheckedJob check_job(const nlohmann::json& document, const std::string& source,
                     const std::filesystem::path& scenarios) {
  Resolution resolution = resolve_in_scenarios(document, source, scenarios);
  CheckedJob checked{std::move(resolution.job)};
  const JobSpec& job = checked.job.spec();
  checked.warnings = deprecated_fields(document);
  const std::vector<Problem> settings = warnings_of_settings(job);
  checked.warnings.insert(checked.warnings.end(), settings.begin(), settings.end());
  const std::vector<std::size_t> shares = shares_of_runs(job);
  double people_of_runs = 0;
  std::vector<ExpectedRun> of_shares(job.mix.empty() ? 1 : job.mix.size());
  for (CheckedScenario& checked_scenario : resolution.scenarios) {
    const int run = checked_scenario.runs().front();
    ScenarioCheck place = check_scenario(checked_scenario);
    const auto runs =
        std::count(shares.begin(), shares.end(), shares[static_cast<std::size_t>(run)]);
    people_of_runs += static_cast<double>(runs) * place.expected.taking_part;
    of_shares[shares[static_cast<std::size_t>(run)]] = place.expected;
    for (Problem& warning : place.warnings) {
      if (!job.mix.empty()) warning.found += " in " + checked_scenario.job().scenario;
      checked.warnings.push_back(std::move(warning));
    }
    if (run == 0) checked.views = std::move(place.views);
  }
  checked.people = std::llround(people_of_runs / job.runs);
  std::vector<ExpectedRun> of_runs;
  of_runs.reserve(shares.size());
  for (const std::size_t share : shares) of_runs.push_back(of_shares[share]);
  checked.cost = estimate_cost(job, of_runs, checked.job.load().models_mib);
  for (Problem& warning : checked.warnings) warning.source = source;
  return checked;
}

nlohmann::json to_json(const CheckedJob& checked) {
  nlohmann::json views = nlohmann::json::array();
  for (const CameraView& view : checked.views) views.push_back(to_json(view));
  nlohmann::json warnings = nlohmann::json::array();
  for (const Problem& warning : checked.warnings) warnings.push_back(warning_json(warning));
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
