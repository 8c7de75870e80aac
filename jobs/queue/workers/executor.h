// Executor of tasks: the plug-in point between a job and the machines. All are listed in
// jobs/queue/executors.h.
#pragma once

#include <cstdint>
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

/// Why a task ended.
enum class Outcome {
  succeeded,
  input_error,        ///< the job is wrong: retrying cannot help
  environment_error,  ///< the machine failed, also after retries
  crashed,            ///< the worker died, also after retries
  timed_out,          ///< the worker hung or took too long, also after retries
  out_of_memory,      ///< likewise
  cancelled,
};

struct TaskResult {
  Outcome outcome = Outcome::succeeded;
  int attempts = 0;
  std::string message;            ///< what went wrong, for people
  std::vector<Problem> problems;  ///< of an input error
};

/// A step of one task: `done` of `total`, in the task's own unit (frames, seconds).
struct TaskProgress {
  double done = 0;
  double total = 0;
  std::string what = {};  ///< what is being done, where the task says so
  std::string node = {};  ///< of a cluster; "" on this machine
};

/// The work of a node of a cluster.
struct NodeWork {
  std::string node = {};
  int running = 0;    ///< tasks now
  int done = 0;       ///< tasks that succeeded
  int failed = 0;     ///< attempts that did not, for whatever reason
  double busy_s = 0;  ///< of attempts that ended, in all
};

/// Owner, job and needs of tasks: decide the order where several jobs have tasks
/// (jobs/queue/workers/admission.h).
struct Share {
  std::string owner = {};                            ///< id of a key; "" for nobody in particular
  std::string job = {};                              ///< id; older jobs have smaller ones
  std::function<int()> priority = [] { return 0; };  ///< asked again for each task
  std::function<std::int64_t(const Task&)> memory_mib = [](const Task&) { return 0; };
  std::size_t later_tasks = 0;  ///< that follow once these are done
  /// Gets the reason why no task of the job runs although it could, and "" once one does.
  std::function<void(const std::string& reason)> on_wait = [](const std::string&) {};
};

class Executor {
 public:
  using OnProgress = std::function<void(const Task&, const TaskProgress&)>;

  Executor() = default;
  Executor(const Executor&) = delete;
  Executor& operator=(const Executor&) = delete;
  virtual ~Executor() = default;

  /// Runs independent tasks of one job, as many at once as is good, and returns when none runs any
  /// more; results are in the order of the tasks. Failures of the machine are retried. Once a task
  /// has failed for good, the others of its run are ended or not begun: they count as cancelled.
  /// So do all others once `stop` asks, or the job itself turns out to be wrong (an input error).
  /// Calls `on_progress` from the calling thread. Safe to use from many threads, each with another
  /// folder or other tasks.
  virtual std::vector<TaskResult> run(const JobFolder& folder, std::span<const Task> tasks,
                                      const OnProgress& on_progress, std::stop_token stop,
                                      const Share& share) = 0;
  /// Likewise, of nobody in particular.
  std::vector<TaskResult> run(const JobFolder& folder, std::span<const Task> tasks,
                              const OnProgress& on_progress, std::stop_token stop) {
    return run(folder, tasks, on_progress, std::move(stop), Share{});
  }

  /// From now on a stop leaves tasks running that another process can take up: the next run() of
  /// them, in whatever process, finds them again. Nothing where tasks end with this process.
  virtual void leave_tasks() {}

  /// The work of a cluster's nodes for the job in a folder, and for all since this process began.
  /// Empty where there is no cluster.
  virtual std::vector<NodeWork> nodes_of(const JobFolder& /*folder*/) const { return {}; }
  virtual std::vector<NodeWork> nodes() const { return {}; }
};

}  // namespace throng::jobs
