// Runs tasks as array jobs of Slurm, on nodes that share the job's folder with this machine.
//
// A task's attempt is one index of an array that Slurm never restarts; its folder is its right to
// publish (jobs/queue/workers/attempts.h). Workers say what they do in files there, and Slurm says
// what has become of them. Tasks of an earlier process are taken up again: their arrays lie in the
// job's folder. While the controller does not answer, tasks that run go on and nothing fails.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "jobs/queue/slurm/node_records.h"
#include "jobs/queue/slurm/slurm_controller.h"
#include "jobs/queue/slurm/slurm_options.h"
#include "jobs/queue/slurm/slurm_submission.h"
#include "jobs/queue/workers/executor.h"
#include "jobs/queue/workers/local_processes.h"

namespace throng::jobs {

/// Arrays that calls of run() of this process look after, by name. Safe to use from many threads.
class SlurmArrayNames {
 public:
  /// False when somebody else has it.
  bool take(const std::string& array);
  void give_back(const std::string& array);

 private:
  std::mutex mutex_;
  std::set<std::string> names_;
};

/// Shared by all calls of run().
struct SlurmShared {
  SlurmOptions options;
  SlurmController controller;
  NodeRecords book = {};
  SlurmArrayNames arrays = {};
  /// Tasks of an array: a controller with a smaller MaxArraySize is found out by its refusals.
  std::atomic<std::size_t> max_tasks = kMaxArrayTasks;
  std::atomic<bool> leaves_tasks = false;
};

/// Datasets are published by processes of this machine: nodes need no way out of the cluster and
/// see no credentials.
class SlurmArrays final : public Executor {
 public:
  /// `here`: how tasks run on this machine.
  explicit SlurmArrays(const SlurmOptions& options = {}, LocalProcessesOptions here = {});

  using Executor::run;
  std::vector<TaskResult> run(const JobFolder& folder, std::span<const Task> tasks,
                              const OnProgress& on_progress, std::stop_token stop,
                              const Share& share) override;
  void leave_tasks() override { shared_->leaves_tasks = true; }
  std::vector<NodeWork> nodes_of(const JobFolder& folder) const override {
    return shared_->book.of(JobFolder(std::filesystem::absolute(folder.path())));
  }
  std::vector<NodeWork> nodes() const override { return shared_->book.all(); }

 private:
  std::unique_ptr<SlurmShared> shared_;
  LocalProcesses here_;
};

/// Asks Slurm whether it knows partition, account and resources. Throws InputError with its answer
/// when it refuses them. Returns why it gave no answer; "" when it gave one.
std::string check_slurm(const SlurmOptions& options);

}  // namespace throng::jobs
