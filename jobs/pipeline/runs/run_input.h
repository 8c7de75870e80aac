// Input of the simulation for a run of a job.
#pragma once

#include <cstdint>
#include <vector>

#include "base/error.h"
#include "spec/annotate/ground_truth.h"
#include "spec/job/spec.h"
#include "spec/sim/run_spec.h"
#include "world/scenario.h"

namespace throng::jobs {

/// Whether the job requests this kind of ground truth.
bool wants(const JobSpec& job, annotate::GroundTruth kind);

/// Input of the simulation for a run of the job. `notes` receives warnings of the reader of
/// recorded people.
sim::RunSpec run_spec(const JobSpec& job, int run, std::vector<Problem>* notes = nullptr);

/// Warnings about a run: those of its simulation, of its recorded people, if there are any (`notes`
/// of run_spec()), and of its scenario.
std::vector<Problem> warnings_of_run(std::vector<Problem> warnings, const sim::RunSpec& spec,
                                     std::vector<Problem> notes, const world::Scenario& scenario);

/// The drones' missions in a run, with its cameras. `run_job` must be the result of job_of_run().
std::vector<sim::DroneMission> make_missions(const JobSpec& run_job, std::uint64_t run_seed);

}  // namespace throng::jobs
