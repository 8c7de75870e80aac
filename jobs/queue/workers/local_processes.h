// Executor that runs tasks as child processes of this process.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/compute/steady_time.h"
#include "jobs/queue/workers/admission.h"
#include "jobs/queue/workers/executor.h"
#include "jobs/queue/workers/task_meters.h"

namespace throng::jobs {

/// Options of LocalProcesses.
struct LocalProcessesOptions {
  /// Program and first arguments of a worker; " --job FOLDER --task NAME" is appended. Empty: this
  /// program with the argument "worker".
  std::vector<std::string> command = {};
  /// Max number of workers over all calls of run(); 0: one per core.
  int workers = 0;
  /// Max sum of Share::memory_mib over all running tasks; 0: unlimited.
  std::int64_t memory_mib = 0;
  /// Whether tasks wait while the machine has less free memory than they need.
  bool waits_for_memory = false;
  /// Max number of attempts at a task, unless it fails with an input error.
  int attempts = 3;
  /// Pause before the second attempt at a task; each further pause is four times as long.
  double rest_s = 1;
  /// A worker that sends no message for this time is considered dead and killed.
  double lease_s = 60;
  /// Max duration of an attempt; 0: unlimited.
  double max_task_s = 0;
  /// Max address space of a worker; 0: unlimited.
  int worker_memory_mib = 0;
  /// If worker_memory_mib is 0: whether to limit a worker's private data to twice its task's
  /// Share::memory_mib plus 2 GiB. (Address space is no measure with a GPU's driver.)
  bool limits_by_need = false;
  /// Time between SIGTERM and SIGKILL for a worker that is to end.
  double grace_s = 2;
  /// Receives the attempts that end; may be null.
  std::shared_ptr<TaskMeters> meters = {};
  /// Clock of pauses, leases and durations.
  SteadyNow now = &steady_now;
};

/// Each worker leads a process group of its own, so that its children end with it, and asks the
/// kernel to end it when this process dies.
class LocalProcesses final : public Executor {
 public:
  explicit LocalProcesses(LocalProcessesOptions options = {});

  const std::shared_ptr<TaskMeters>& meters() const { return options_.meters; }

  using Executor::run;
  std::vector<TaskResult> run(const JobFolder& folder, std::span<const Task> tasks,
                              const OnProgress& on_progress, std::stop_token stop,
                              const Share& share) override;
  void drain(std::chrono::milliseconds limit, const std::stop_token& stop) override {
    admission_->drain(limit, stop);
  }

 private:
  LocalProcessesOptions options_;
  std::unique_ptr<Admission> admission_;
};

}  // namespace throng::jobs
