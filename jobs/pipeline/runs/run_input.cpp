#include "jobs/pipeline/runs/run_input.h"

#include <memory>
#include <utility>

#include "jobs/pipeline/runs/job_scenario.h"
#include "jobs/pipeline/runs/recording.h"
#include "spec/job/environment.h"
#include "spec/job/scenario_mix.h"
#include "world/trace.h"

namespace throng::jobs {

bool wants(const JobSpec& job, annotate::GroundTruth kind) {
  return annotate::holds(job.outputs.annotations, kind);
}

sim::RunSpec run_spec(const JobSpec& whole_job, int run, std::vector<Problem>* notes) {
  const JobSpec job = job_of_run(whole_job, run);
  sim::RunSpec spec;
  spec.seed = run_seed(job, run);
  spec.duration_s = job.capture.end_s();
  if (!job.drones.empty()) spec.images_from_s = job.capture.from_s;
  spec.people = job.agents;
  spec.crowd = job.crowd;
  if (job.recorded) {
    spec.recorded = std::make_shared<const world::Trace>(read_recording(*job.recorded, notes));
  }
  spec.wind = environment_of_run(job.environment, spec.seed).wind;
  spec.drones = make_missions(job, spec.seed);
  return spec;
}

std::vector<Problem> warnings_of_run(std::vector<Problem> warnings, const sim::RunSpec& spec,
                                     std::vector<Problem> notes, const world::Scenario& scenario) {
  if (spec.recorded) {
    for (Problem& warning : recording_warnings(std::move(notes), *spec.recorded, scenario)) {
      warnings.push_back(std::move(warning));
    }
  }
  return with_scenario_findings(std::move(warnings), scenario);
}

std::vector<sim::DroneMission> make_missions(const JobSpec& run_job, std::uint64_t run_seed) {
  std::vector<sim::DroneMission> missions;
  for (std::size_t i = 0; i < run_job.drones.size(); ++i) {
    sim::DroneMission& mission = missions.emplace_back(run_job.drones[i].mission);
    mission.camera = camera_of_run(run_job.drones[i].camera, run_seed, camera_pointer(i));
  }
  return missions;
}

}  // namespace throng::jobs
