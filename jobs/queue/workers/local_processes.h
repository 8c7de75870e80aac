// Runs tasks as child processes of this one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/compute/steady_time.h"
#include "jobs/queue/workers/admission.h"
#include "jobs/queue/workers/executor.h"

namespace throng::jobs {

struct LocalProcessesOptions {
  /// Program and first arguments of a worker; " --job FOLDER --task NAME" is appended. Empty: this
  /// program with the argument "worker".
  std::vector<std::string> command = {};
  /// Workers at once, over all calls of run(); 0: one per core.
  int workers = 0;
  /// That all workers may need together by Share::memory_mib; 0: any.
  std::int64_t memory_mib = 0;
  /// Whether tasks wait while the machine has less memory left than they need.
  bool waits_for_memory = false;
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
  /// Without that: whether a worker may have twice the memory that its task is expected to need
  /// (Share::memory_mib) and 2 GiB, as private data, which is what counts of a GPU's driver.
  bool limits_by_need = false;
  /// How long a worker may take to end after SIGTERM, before SIGKILL.
  double grace_s = 2;
  /// By which tasks rest, and leases and the longest time of a task are measured.
  SteadyNow now = &steady_now;
};

/// Each worker leads a process group of its own, so that ending it ends its children too, and asks
/// the kernel to end it when this process dies.
class LocalProcesses final : public Executor {
 public:
  explicit LocalProcesses(LocalProcessesOptions options = {});

  using Executor::run;
  std::vector<TaskResult> run(const JobFolder& folder, std::span<const Task> tasks,
                              const OnProgress& on_progress, std::stop_token stop,
                              const Share& share) override;

 private:
  LocalProcessesOptions options_;
  std::unique_ptr<Admission> admission_;
};

}  // namespace throng::jobs
