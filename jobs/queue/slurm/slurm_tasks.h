// The tasks of one call of SlurmArrays::run(): those that wait to be submitted, and results.
#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <map>
#include <utility>
#include <vector>

#include "base/compute/steady_time.h"
#include "jobs/queue/slurm/slurm_call.h"
#include "jobs/queue/slurm/slurm_submission.h"
#include "jobs/queue/workers/executor.h"

namespace throng::jobs {

/// Decides which tasks are tried again. Tasks are named by their index in SlurmCall::tasks.
class SlurmTasks {
 public:
  using Condition = std::function<bool(const Task&)>;

  /// `call` must outlive this object.
  explicit SlurmTasks(const SlurmCall& call)
      : call_(call), ledgers_(call.tasks.size()), results_(call.tasks.size()) {}

  /// The result so far, with the number of attempts.
  TaskResult& result(std::size_t task) { return results_[task]; }
  /// All results, which this object loses.
  std::vector<TaskResult> take_results() { return std::move(results_); }

  /// Lets a task wait to be submitted, after a rest.
  void wait(std::size_t task, double rest_s = 0);
  bool is_one_waiting() const { return !waiting_.empty(); }
  /// Takes the waiting tasks that need not rest, by what they need.
  std::map<SlurmNeed, std::vector<std::size_t>> take_ready();
  /// Ends the waiting of tasks as cancelled.
  void cancel_waiting(const Condition& condition);

  /// Takes back the last attempt at a task, which counts for nothing.
  void take_back(std::size_t task, double rest_s = 0);
  /// Lets the task of an attempt that failed rest and wait, or gives it up. Then returns which
  /// other tasks are to be ended: those of its run, or all if the job is wrong; else null.
  Condition fail(std::size_t task, TaskResult result);
  /// Takes back an attempt that was lost; if that happens all the time, as fail().
  Condition lose(std::size_t task, TaskResult result, bool is_preempted);

 private:
  /// Counters of a task.
  struct Ledger {
    int losses = 0;       ///< attempts lost through no fault of the task
    int exhaustions = 0;  ///< attempts that ran out of memory
  };

  struct Waiting {
    std::size_t task;
    SteadyTime from;  ///< not to be submitted earlier
  };

  const SlurmCall& call_;
  std::deque<Waiting> waiting_;
  std::vector<Ledger> ledgers_;
  std::vector<TaskResult> results_;
};

}  // namespace throng::jobs
