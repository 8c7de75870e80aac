// A job's folder, which contains all files of one job.
//
//   job.json                  the resolved job, with all defaults
//   recorded/                 recorded trajectories that the job replays, if any
//   work/run000/trace.h5      output of the task run000/trace; its hash is in trace.h5.sha256
//   work/run000/metrics/      metrics.json, exits.csv
//   work/run000/shard0003/    images, density maps, previews, records of its frames
//   failed_runs.json          runs that the dataset lacks, if any
//   dataset/                  the result; complete if it exists
//   published.json            target of the upload, if the job asks for one (jobs/queue/delivery.h)
//   logs/                     stderr of the workers
//   logs/nodes.jsonl          attempts by node of a cluster (jobs/queue/slurm/node_records.h)
//   attempts/                 files of a cluster's workers (jobs/queue/workers/attempts.h)
#pragma once

#include <filesystem>

#include "spec/job/plan.h"
#include "spec/job/resolved_job.h"

namespace throng::jobs {

/// Paths within a job's folder; holds no resources.
class JobFolder {
 public:
  explicit JobFolder(std::filesystem::path path) : path_(std::move(path)) {}

  /// Creates the folder for a job, or continues with an existing folder of the same job; jobs that
  /// differ only in the address to publish to count as the same. Throws InputError if the folder
  /// contains another job or other files, and EnvironmentError.
  static JobFolder create(std::filesystem::path path, const ResolvedJob& resolved);

  /// As create(), for a folder whose name identifies the job: a job.json that is missing, damaged
  /// or different is replaced.
  static JobFolder restore(std::filesystem::path path, const ResolvedJob& resolved);

  /// Reads job.json. Throws EnvironmentError and InputError.
  ResolvedJob read_job() const;

  /// Whether a task has published its output, which appears whole or not at all.
  bool is_done(const Task& task) const;

  /// Removes what is in the place of a folder and is none, output without content, and a dataset
  /// without its manifest: the tasks that made them are not done. Call it as remove_leftovers().
  void remove_damaged() const;

  /// Removes incomplete output of workers that died. Call it only while no worker runs in the
  /// folder.
  void remove_leftovers() const;

  const std::filesystem::path& path() const { return path_; }
  /// Path of a task's output: a folder for Task::Kind::measure, render and collect, a file for all
  /// others. Not for a study's runs (spec/study/study_files.h).
  std::filesystem::path output_of(const Task& task) const;
  std::filesystem::path log_file(const Task& task) const;
  /// Path of the log of the task with this name.
  std::filesystem::path log_file(std::string task_name) const;
  std::filesystem::path job_file() const { return path_ / "job.json"; }
  std::filesystem::path dataset() const { return path_ / "dataset"; }

 private:
  std::filesystem::path path_;
};

}  // namespace throng::jobs
