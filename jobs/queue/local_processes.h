// Runs tasks as child processes of this one.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "jobs/queue/executor.h"

namespace throng::jobs {

struct LocalProcessesOptions {
  /// Program and first arguments of a worker; " --job FOLDER --task NAME" is appended. Empty: this
  /// program with the argument "worker".
  std::vector<std::string> command = {};
  /// Workers at once; 0: one per core.
  int workers = 0;
  /// How often a task is begun before a failure of the machine is final.
  int attempts = 3;
  /// How long a task rests after its first failure; four times as long after each further one.
  double rest_s = 1;
  /// A worker that has said nothing for so long is taken for dead and killed.
  double lease_s = 60;
  /// The longest that a task may take; 0: any time.
  double max_task_s = 0;
  /// Address space that a worker may use; 0: any.
  int worker_memory_mib = 0;
  /// How long a worker may take to end after SIGTERM, before SIGKILL.
  double grace_s = 2;
};

/// Each worker leads a process group of its own, so that ending it ends its children too, and asks
/// the kernel to end it when this process dies. Use from one thread at a time.
class LocalProcesses final : public Executor {
 public:
  explicit LocalProcesses(LocalProcessesOptions options = {});

  std::vector<TaskResult> run(const JobFolder& folder, std::span<const Task> tasks,
                              const OnProgress& on_progress, std::stop_token stop) override;

 private:
  LocalProcessesOptions options_;
};

}  // namespace throng::jobs
