// Executor that runs tasks as array jobs of Slurm, on nodes that share the job's folder with this
// machine.
//
// An attempt at a task is one index of an array that Slurm never restarts; its folder is its right
// to publish (jobs/queue/workers/attempts.h). Workers write messages to files there, and Slurm
// reports the state of their processes. Tasks of an earlier process are taken up again, because
// their arrays are in the job's folder. While the controller does not answer, running tasks go on
// and no task fails.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <set>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "jobs/queue/slurm/node_records.h"
#include "jobs/queue/slurm/slurm_call.h"
#include "jobs/queue/slurm/slurm_controller.h"
#include "jobs/queue/slurm/slurm_options.h"
#include "jobs/queue/slurm/slurm_submission.h"
#include "jobs/queue/workers/executor.h"
#include "jobs/queue/workers/local_processes.h"

namespace throng::jobs {

/// Tasks that publish datasets run on this machine, so that nodes need no access to other networks
/// and get no credentials.
class SlurmArrays final : public Executor {
 public:
  /// `here` has the options of tasks that run on this machine.
  explicit SlurmArrays(const SlurmOptions& options = {}, LocalProcessesOptions here = {});

  using Executor::run;
  std::vector<TaskResult> run(const JobFolder& folder, std::span<const Task> tasks,
                              const OnProgress& on_progress, std::stop_token stop,
                              const Share& share) override;
  void leave_tasks() override { shared_->leaves_tasks = true; }
  void drain(std::chrono::milliseconds limit, const std::stop_token& stop) override {
    here_.drain(limit, stop);  // those of nodes survive this process
  }
  std::vector<NodeWork> nodes_of(const JobFolder& folder) const override {
    return shared_->book.of(JobFolder(std::filesystem::absolute(folder.path())));
  }
  std::vector<NodeWork> nodes() const override { return shared_->book.all(); }

 private:
  std::unique_ptr<SlurmShared> shared_;
  LocalProcesses here_;
};

/// Asks Slurm whether it accepts partition, account and resources. Throws InputError with its
/// answer if it refuses them. Returns why it did not answer; "" if it accepts.
std::string check_slurm(const SlurmOptions& options);

}  // namespace throng::jobs
