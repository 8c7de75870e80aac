#include "jobs/pipeline/checks/rehearsal.h"

#include <fmt/core.h>

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "jobs/pipeline/runs/run_input.h"
#include "places/scenarios/check/check.h"
#include "sim/people/people_watch.h"
#include "sim/run.h"
#include "world/alarm.h"

namespace throng::jobs {

namespace {

constexpr double kMaxMoves = 500'000;  // people times steps

/// Stops when somebody knows of the alarm or enough was simulated.
class Rehearsal : public sim::RunObserver {
 public:
  explicit Rehearsal(const world::Scenario& scenario) : scenario_(scenario) {}

  void begin(const world::TraceHeader& header) override {
    watch_.emplace(scenario_, header, std::nullopt);
  }
  void step(const world::CrowdStep& step) override {
    watch_->look(step);
    moves_ += static_cast<double>(step.position.size());
  }
  bool done() const override { return watch_->anybody_noticed() || moves_ > kMaxMoves; }

  const sim::PeopleWatch& watch() const { return *watch_; }

 private:
  const world::Scenario& scenario_;
  std::optional<sim::PeopleWatch> watch_;
  double moves_ = 0;
};

}  // namespace

std::vector<Problem> scenario_findings(const world::Scenario& scenario) {
  std::vector<Problem> found;
  for (const scenarios::Finding& finding : scenarios::check(scenario, scenario.id)) {
    const Problem& problem = finding.problem;
    const char* severity = finding.severity == scenarios::Severity::error ? "error" : "warning";
    found.push_back(
        {"", "/scenario",
         fmt::format("{} in {}, {}: {}", severity, problem.source, problem.where, problem.found),
         problem.expected});
  }
  return found;
}

std::vector<Problem> with_scenario_findings(std::vector<Problem> warnings,
                                            const world::Scenario& scenario) {
  std::set<std::string> said;  // of the crowd's files, which a run reads, too
  for (const Problem& warning : warnings) said.insert(warning.found);
  for (Problem& finding : scenario_findings(scenario)) {
    const bool is_said = std::any_of(said.begin(), said.end(), [&](const std::string& found) {
      return finding.found.ends_with(": " + found);
    });
    if (!is_said) warnings.push_back(std::move(finding));
  }
  return warnings;
}

std::vector<Problem> rehearse(CheckedScenario& checked, std::int64_t people) {
  const JobSpec& job = checked.job();
  const world::Scenario& scenario = checked.scenario();
  const std::optional<double> alarm_s = world::find_alarm(scenario).at_s;
  if (!alarm_s || job.recorded || job.agents == 0) return {};
  sim::RunSpec spec = run_spec(job, checked.runs().front());
  if (*alarm_s > spec.duration_s) {
    if (!job.drones.empty()) return {};
    return {sim::late_alarm(*alarm_s, spec.duration_s)};
  }
  constexpr double kUsualStepS = 0.1;
  constexpr double kPatienceS = 10;  // after the alarm; a run is not said to be idle before
  if (static_cast<double>(people) * (*alarm_s + kPatienceS) > kMaxMoves * kUsualStepS) return {};
  Rehearsal rehearsal(scenario);
  sim::simulate(scenario, spec, rehearsal, {}, {}, checked.take_people());
  return rehearsal.watch().idleness();
}

}  // namespace throng::jobs
