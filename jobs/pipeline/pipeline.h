// The tasks of a job, as a worker performs them. A task reads the output of earlier tasks from the
// job's folder and publishes its own output atomically, so it can be repeated at any time; a task
// whose output exists changes nothing. Equal jobs give equal bytes. All tasks throw InputError and
// EnvironmentError, and Cancelled after a request by `stop`; `scenarios` is the folder of
// scenarios.
#pragma once

#include <filesystem>
#include <stop_token>

#include "jobs/queue/dataset/folder.h"
#include "jobs/queue/workers/executor.h"
#include "spec/job/plan.h"
#include "spec/job/resolved_job.h"

namespace throng::jobs {

/// Simulates a run and writes work/run000/trace.h5. Progress in simulated seconds.
void simulate_run(const JobFolder& folder, const JobSpec& job,
                  const std::filesystem::path& scenarios, int run,
                  const OnTaskProgress& on_progress = {}, const std::stop_token& stop = {});

/// Computes the metrics of a simulated run: work/run000/metrics/{metrics.json,exits.csv}.
void measure_run(const JobFolder& folder, const JobSpec& job,
                 const std::filesystem::path& scenarios, int run);

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
