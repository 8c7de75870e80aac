// Options of the executor that uses Slurm, for all tasks.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/compute/steady_time.h"

namespace throng::jobs {

/// Strings are passed to sbatch as they are; "" leaves the choice to the cluster.
struct SlurmOptions {
  /// Program and first arguments of a worker, with a path that is valid on the nodes; " --job
  /// FOLDER
  /// --array NAME" is appended. Empty: this program, by its path on this machine, with the argument
  /// "worker".
  std::vector<std::string> command = {};
  std::string partition = {};
  std::string account = {};
  std::string time = {};  ///< time limit of a task, in sbatch's syntax
  std::string gres = {};  ///< generic resources of tasks that render: "gpu:1"
  int cpus = 1;           ///< per task
  /// Min memory of a task; 0: by Share::memory_mib, or the partition's default if that is 0, too.
  std::int64_t memory_mib = 0;
  std::vector<std::string> more = {};  ///< further options of sbatch
  int at_once = 0;                     ///< max running tasks of one array; 0: unlimited
  double poll_s = 5;                   ///< pause between two calls of squeue

  int attempts = 3;   ///< as LocalProcessesOptions::attempts
  double rest_s = 1;  ///< as LocalProcessesOptions::rest_s
  /// A worker whose file of messages has not grown for this time is considered dead.
  double lease_s = 120;
  double max_task_s = 0;        ///< as LocalProcessesOptions::max_task_s
  int worker_memory_mib = 0;    ///< as LocalProcessesOptions::worker_memory_mib
  bool limits_by_need = false;  ///< as LocalProcessesOptions::limits_by_need
  /// Number of times that a task may be lost with its node, or before it starts, until a loss
  /// counts as its own failure.
  int max_losses = 10;
  /// Max delay until a file that one machine has written is visible on another.
  double visibility_s = 60;
  /// Clock of pauses, leases and durations.
  SteadyNow now = &steady_now;
};

}  // namespace throng::jobs
