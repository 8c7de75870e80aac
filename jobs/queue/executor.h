// Executor of tasks: the plug-in point between a job and the machines. Local processes now; a
// cluster scheduler implements the same interface.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "base/error.h"
#include "jobs/queue/folder.h"
#include "jobs/spec/plan.h"

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
  /// Calls `on_progress` from the calling thread.
  virtual std::vector<TaskResult> run(const JobFolder& folder, std::span<const Task> tasks,
                                      const OnProgress& on_progress, std::stop_token stop) = 0;
};

}  // namespace throng::jobs
