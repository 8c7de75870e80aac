// Wishes of a user to Slurm, for all tasks.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/compute/steady_time.h"

namespace throng::jobs {

struct SlurmOptions {
  /// Program and first arguments of a worker, as the nodes know it; " --job FOLDER --array NAME" is
  /// appended. Empty: this program, by its path here, with the argument "worker".
  std::vector<std::string> command = {};
  std::string partition = {};  ///< "": the cluster's default
  std::string account = {};    ///< likewise
  std::string time = {};       ///< the longest that a task may take, as sbatch reads it
  std::string gres = {};       ///< of tasks that render: "gpu:1"
  int cpus = 1;                ///< per task
  /// What a task gets at least; 0: by Share::memory_mib, and where that says nothing the default of
  /// the partition.
  std::int64_t memory_mib = 0;
  std::vector<std::string> more = {};  ///< further options of sbatch
  int at_once = 0;                     ///< tasks of one array that may run at once; 0: any number
  double poll_s = 5;                   ///< between two looks at Slurm's queue

  int attempts = 3;   ///< as of LocalProcessesOptions
  double rest_s = 1;  ///< likewise
  /// A worker whose file of messages has not grown for so long is taken for dead.
  double lease_s = 120;
  double max_task_s = 0;        ///< as of LocalProcessesOptions
  int worker_memory_mib = 0;    ///< likewise
  bool limits_by_need = false;  ///< likewise
  /// How often a task may be lost with its node, or before it began, until that counts as its own
  /// failure.
  int max_losses = 10;
  /// How long what one machine has written may take to be seen by another.
  double visibility_s = 60;
  /// By which tasks rest, and leases, the longest time of a task and that of its last words are
  /// measured.
  SteadyNow now = &steady_now;
};

}  // namespace throng::jobs
