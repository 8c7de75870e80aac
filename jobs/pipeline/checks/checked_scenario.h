// A scenario of a job with the people of a run, loaded once for all checks of the job.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "crowd/simulation.h"
#include "spec/job/spec.h"
#include "world/scenario.h"

namespace throng::jobs {

/// The runs of a job that take place in one scenario. The first of them stands for all.
class CheckedScenario {
 public:
  /// `job` is that of this scenario only (in_scenario_of_run()), `runs` are not empty.
  CheckedScenario(JobSpec job, world::Scenario scenario, std::vector<int> runs);

  const JobSpec& job() const { return job_; }
  const world::Scenario& scenario() const { return scenario_; }
  const std::vector<int>& runs() const { return runs_; }

  /// Whether the people come from the trace of a run, which was simulated and has no need of its
  /// crowd: people() cannot load them.
  bool is_of_trace() const;
  /// The people of the first run before its first step (sim::load_people()), loaded by the first
  /// call. Throws InputError and EnvironmentError if they cannot be loaded.
  const crowd::Simulation& people();
  /// The same, for a simulation of that run; the next call of people() would load them again.
  crowd::Simulation take_people();
  /// Positions (m) of the people, recorded ones too, at whom the drones of all runs aim. Empty if
  /// no drone aims, and where the people cannot be loaded, which the simulation will explain.
  const std::vector<Eigen::Vector2d>& people_to_aim_at();

 private:
  JobSpec job_;
  world::Scenario scenario_;
  std::vector<int> runs_;
  std::optional<crowd::Simulation> people_;
  std::optional<std::vector<Eigen::Vector2d>> aimed_at_;
};

}  // namespace throng::jobs
