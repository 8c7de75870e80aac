// failed_runs.json: the runs of a job that failed. The task that collects the dataset reads it and
// leaves these runs out.
#pragma once

#include <string>
#include <vector>

#include "jobs/queue/dataset/folder.h"

namespace throng::jobs {

/// A failed run and the task that failed.
struct FailedRun {
  int run = 0;       ///< index of the run
  std::string task;  ///< name of the failed task, e.g. "run000/shard0003"
};

/// Writes the list; call it before the dataset is collected. Throws EnvironmentError.
void write_failed_runs(const JobFolder& folder, const std::vector<FailedRun>& runs);

/// Reads the list; empty if there is no file. Throws EnvironmentError.
std::vector<FailedRun> read_failed_runs(const JobFolder& folder);

/// Prepares another try: if runs are listed, removes the dataset that lacks them, then the list.
/// Safe to repeat after any interruption.
void forget_failed_runs(const JobFolder& folder);

}  // namespace throng::jobs
