// Interface of executors, which run the tasks of jobs on machines. jobs/queue/executors.h lists all
// implementations.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "jobs/queue/dataset/folder.h"
#include "spec/job/plan.h"

namespace throng::jobs {

/// Final result of a task. "After retries" means that all attempts failed.
enum class Outcome {
  succeeded,
  input_error,        ///< the job is wrong: retrying cannot help
  environment_error,  ///< the machine failed, after retries
  crashed,            ///< the worker died, after retries
  timed_out,          ///< the worker hung or took too long, after retries
  out_of_memory,      ///< the worker ran out of memory, after retries
  cancelled,          ///< stopped, or given up with its run
};

/// Name of an outcome: "succeeded", "out_of_memory".
std::string to_string(Outcome outcome);

/// Outcome of a task and its explanation.
struct TaskResult {
  Outcome outcome = Outcome::succeeded;
  int attempts = 0;
  std::string message;            ///< what went wrong, for people
  std::vector<Problem> problems;  ///< of an input error
  double cpu_s = 0;               ///< CPU time of the attempt that succeeded; 0: unknown
};

/// Progress of one task: `done` of `total`, in the task's own unit (frames, seconds).
struct TaskProgress {
  double done = 0;
  double total = 0;
  std::string what = {};  ///< name of the current step; "" if the task does not name it
  std::string node = {};  ///< the worker's cluster node; "" on this machine
};
using OnTaskProgress = std::function<void(const TaskProgress&)>;

/// Work of one cluster node.
struct NodeWork {
  std::string node = {};  ///< its name
  int running = 0;        ///< tasks that run now
  int done = 0;           ///< tasks that succeeded
  int failed = 0;         ///< attempts that failed, for any reason
  double busy_s = 0;      ///< total duration of the attempts that ended
};

/// Owner, job and needs of a batch of tasks; they decide the order among several jobs
/// (jobs/queue/workers/admission.h).
struct Share {
  std::string owner = {};                            ///< id of a key; "" without keys
  std::string job = {};                              ///< id; older jobs have smaller ids
  std::function<int()> priority = [] { return 0; };  ///< called before each task starts
  /// Estimated memory of a task in MiB; 0: unknown.
  std::function<std::int64_t(const Task&)> memory_mib = [](const Task&) { return 0; };
  std::size_t later_tasks = 0;  ///< number of the job's tasks after this batch
  /// File in which run_job() keeps what it learns of this machine (jobs/queue/machine_speed.h); ""
  /// for none.
  std::filesystem::path speed_file = {};
  /// Receives the reason why no task of the job runs although some are ready, then "" once one
  /// does.
  std::function<void(const std::string& reason)> on_wait = [](const std::string&) {};
};

/// Runs tasks of jobs; retries failures of the machine.
class Executor {
 public:
  using OnProgress = std::function<void(const Task&, const TaskProgress&)>;

  Executor() = default;
  Executor(const Executor&) = delete;
  Executor& operator=(const Executor&) = delete;
  virtual ~Executor() = default;

  /// Runs independent tasks of one job, several at once, and returns when none runs any more; the
  /// results are in the order of the tasks. Failures of the machine are retried. When a task has
  /// failed finally, the other tasks of its run are ended or not started, with Outcome::cancelled;
  /// after an input error or a request by `stop`, all other tasks are. Calls `on_progress` from the
  /// calling thread. Safe to call from many threads, each with another folder or other tasks.
  virtual std::vector<TaskResult> run(const JobFolder& folder, std::span<const Task> tasks,
                                      const OnProgress& on_progress, std::stop_token stop,
                                      const Share& share) = 0;
  /// Runs tasks without an owner.
  std::vector<TaskResult> run(const JobFolder& folder, std::span<const Task> tasks,
                              const OnProgress& on_progress, std::stop_token stop) {
    return run(folder, tasks, on_progress, std::move(stop), Share{});
  }

  /// From now on, a stop leaves those tasks running that survive this process; the next run() with
  /// these tasks, in any process, takes them up again. No effect if tasks end with this process.
  virtual void leave_tasks() {}

  /// Starts no more tasks on this machine: they wait until a stop is requested. Blocks until none
  /// runs, for at most `limit` or until a request by `stop`.
  virtual void drain(std::chrono::milliseconds /*limit*/, const std::stop_token& /*stop*/) {}

  /// Work of the cluster's nodes for the job in a folder; empty without a cluster.
  virtual std::vector<NodeWork> nodes_of(const JobFolder& /*folder*/) const { return {}; }
  /// Work of the cluster's nodes for all jobs since this process started; empty without a cluster.
  virtual std::vector<NodeWork> nodes() const { return {}; }
};

}  // namespace throng::jobs
