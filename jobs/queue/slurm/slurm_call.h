// State of a call of SlurmArrays::run(), which all its parts share.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <set>
#include <span>
#include <stop_token>
#include <string>

#include "jobs/queue/slurm/node_records.h"
#include "jobs/queue/slurm/slurm_controller.h"
#include "jobs/queue/slurm/slurm_options.h"
#include "jobs/queue/slurm/slurm_submission.h"
#include "jobs/queue/workers/executor.h"
#include "jobs/queue/workers/task_meters.h"

namespace throng::jobs {

/// Names of the arrays that the calls of run() in this process supervise. Safe to use from many
/// threads.
class SlurmArrayNames {
 public:
  /// Takes an array; returns false if another call has it.
  bool take(const std::string& array);
  void give_back(const std::string& array);

 private:
  std::mutex mutex_;
  std::set<std::string> names_;
};

/// State shared by all calls of run().
struct SlurmShared {
  SlurmOptions options;
  SlurmController controller;
  NodeRecords book = {};
  SlurmArrayNames arrays = {};
  /// Max number of tasks in an array; lowered when the controller refuses an array for its size.
  std::atomic<std::size_t> max_tasks = kMaxArrayTasks;
  std::atomic<bool> leaves_tasks = false;
  std::shared_ptr<TaskMeters> meters = {};  ///< may be null
};

/// One call of run(): its arguments, which outlive all that is made for it.
struct SlurmCall {
  SlurmShared& shared;
  const JobFolder& folder;
  std::span<const Task> tasks;
  const Executor::OnProgress& on_progress;
  std::stop_token stop;
  const Share& share;
};

}  // namespace throng::jobs
