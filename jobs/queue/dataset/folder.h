// A job's folder: where everything that belongs to one job lies.
//
//   job.json                  the job as it was resolved, with all defaults
//   recorded/                 the trajectories that the job replays, if it does
//   work/run000/trace.h5      published by the task run000/trace; its hash in trace.h5.sha256
//   work/run000/metrics/      metrics.json, exits.csv
//   work/run000/shard0003/    images, density maps, previews, records of its frames
//   failed_runs.json          runs that the dataset lacks, if any
//   dataset/                  the result; complete when it is there
//   published.json            where it was brought, if the job asks for that
//   (jobs/queue/delivery.h) logs/                     what the workers said; logs/nodes.jsonl: on
//   which nodes of a cluster attempts/                 of a cluster's workers
//   (jobs/queue/workers/attempts.h)
#pragma once

#include <filesystem>

#include "spec/job/plan.h"
#include "spec/job/resolved_job.h"

namespace throng::jobs {

class JobFolder {
 public:
  explicit JobFolder(std::filesystem::path path) : path_(std::move(path)) {}

  /// Creates the folder for a job, or checks that the one there is for the same job (then work that
  /// it holds is taken up). An address to publish to makes no other job. Throws InputError
  /// when it holds another job or other files, and EnvironmentError.
  static JobFolder create(std::filesystem::path path, const ResolvedJob& resolved);

  /// Likewise for a folder that is named after the job, so that it can hold no other: a job.json
  /// that is gone or damaged is written again.
  static JobFolder restore(std::filesystem::path path, const ResolvedJob& resolved);

  /// Reads job.json, which was checked when the folder was made. Throws EnvironmentError and
  /// InputError.
  ResolvedJob read_job() const;

  /// Whether a task has published its output: it appears complete or not at all.
  bool is_done(const Task& task) const;

  /// Removes what workers that died left half-written. Only while no worker is at work here.
  void remove_leftovers() const;

  const std::filesystem::path& path() const { return path_; }
  /// Output of the task: a file for a simulation, a calibration and a report, else a folder. Not
  /// for a study's runs (spec/study/study_files.h).
  std::filesystem::path output_of(const Task& task) const;
  std::filesystem::path log_file(const Task& task) const;
  /// Likewise by the task's name.
  std::filesystem::path log_file(std::string task_name) const;
  std::filesystem::path job_file() const { return path_ / "job.json"; }
  std::filesystem::path dataset() const { return path_ / "dataset"; }

 private:
  std::filesystem::path path_;
};

}  // namespace throng::jobs
