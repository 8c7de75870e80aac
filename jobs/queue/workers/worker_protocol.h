// Protocol between a supervisor and its worker processes besides the lines of
// jobs/queue/workers/worker_messages.h: exit codes and environment variables.
#pragma once

namespace throng::jobs {

/// Exit codes of a worker. Any other means that it crashed.
enum WorkerExit : int {
  worker_succeeded = 0,
  worker_input_error = 2,        ///< the job is wrong
  worker_environment_error = 3,  ///< the machine failed
  worker_out_of_memory = 4,
  worker_bug = 70,  ///< an exception nobody expected
  /// The attempt was taken back, or another process has begun it: nothing was done.
  worker_not_begun = 75,
};

/// The supervising process's id; a worker that finds itself without that parent ends at once.
inline constexpr const char* kSupervisorVariable = "THRONG_SUPERVISOR_PID";

/// How often the task has been begun, this time included. Unset: 1.
inline constexpr const char* kAttemptVariable = "THRONG_ATTEMPT";

}  // namespace throng::jobs
