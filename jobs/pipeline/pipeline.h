// The tasks of a job, as a worker performs them. A task reads the output of earlier tasks from the
// job's folder and publishes its own output atomically, so it can be repeated at any time; a task
// whose output exists changes nothing. Equal jobs give equal bytes. All tasks throw InputError and
// EnvironmentError, and Cancelled after a request by `stop`; `scenarios` is the folder of
// scenarios.
#pragma once

#include <filesystem>
#include <functional>
#include <stop_token>

#include "jobs/queue/dataset/folder.h"
#include "jobs/queue/workers/executor.h"
#include "sim/run.h"
#include "spec/annotate/ground_truth.h"
#include "spec/job/plan.h"
#include "spec/job/resolved_job.h"

namespace throng::jobs {

using OnTaskProgress = std::function<void(const TaskProgress&)>;

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

/// Simulates a run and writes work/run000/trace.h5. Progress in simulated seconds.
void simulate_run(const JobFolder& folder, const JobSpec& job,
                  const std::filesystem::path& scenarios, int run,
                  const OnTaskProgress& on_progress = {}, const std::stop_token& stop = {});

/// Computes the metrics of a simulated run: work/run000/metrics/{metrics.json,exits.csv}.
void measure_run(const JobFolder& folder, const JobSpec& job,
                 const std::filesystem::path& scenarios, int run);

/// Renders and labels the frames of a shard: work/run000/shard0000/. Progress in images.
void render_shard(const JobFolder& folder, const JobSpec& job,
                  const std::filesystem::path& scenarios, const Shard& shard,
                  const OnTaskProgress& on_progress = {}, const std::stop_token& stop = {});

/// Collects the output of all other tasks in dataset/ and writes its manifest.
void collect_dataset(const JobFolder& folder, const JobSpec& job);

/// Uploads the dataset to the object store that the job names and writes published.json. Progress
/// in bytes.
void publish_job(const JobFolder& folder, const JobSpec& job,
                 const OnTaskProgress& on_progress = {}, const std::stop_token& stop = {});

/// Performs any task of the job.
void do_task(const JobFolder& folder, const ResolvedJob& resolved,
             const std::filesystem::path& scenarios, const Task& task,
             const OnTaskProgress& on_progress = {}, const std::stop_token& stop = {});

}  // namespace throng::jobs
