// Protocol between a supervisor and its worker processes: exit codes and environment variables.
// jobs/queue/workers/worker_messages.h has the lines on stdout.
#pragma once

namespace throng::jobs {

/// Exit codes of a worker. Any other means that it crashed.
enum WorkerExit : int {
  worker_succeeded = 0,
  worker_input_error = 2,        ///< the job is wrong
  worker_environment_error = 3,  ///< the machine failed
  worker_out_of_memory = 4,
  worker_bug = 70,  ///< an unexpected exception
  /// The attempt was revoked, or another process has started it: nothing was done.
  worker_not_begun = 75,
};

/// Environment variable with the supervisor's process id; a worker with another parent ends at
/// once.
inline constexpr const char* kSupervisorVariable = "THRONG_SUPERVISOR_PID";

/// Environment variable with the number of the attempt at the task, from 1. Unset: 1.
inline constexpr const char* kAttemptVariable = "THRONG_ATTEMPT";

}  // namespace throng::jobs
