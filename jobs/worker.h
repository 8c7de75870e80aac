// The worker: one process, one task. It speaks to who started it through stdout, one JSON object
// per line, and its exit code; everything else it has to say goes to stderr.
#pragma once

#include <filesystem>
#include <string>

namespace throng::jobs {

/// Exit codes of a worker. Any other means that it crashed.
enum WorkerExit : int {
  worker_succeeded = 0,
  worker_input_error = 2,        ///< the job is wrong
  worker_environment_error = 3,  ///< the machine failed
  worker_out_of_memory = 4,
  worker_bug = 70,  ///< an exception nobody expected
};

/// The supervising process's id; a worker that finds itself without that parent ends at once.
inline constexpr const char* kSupervisorVariable = "THRONG_SUPERVISOR_PID";

/// How often the task has been begun, this time included. Unset: 1.
inline constexpr const char* kAttemptVariable = "THRONG_ATTEMPT";

/// Runs the task in the job's folder and returns the process's exit code. Writes
///   {"done":3,"total":30}
/// lines as it goes on, {} lines as signs of life in between and, when it fails,
///   {"error":{"kind":"input"|"environment"|"bug","message":...,"problems":[{"source","where","found","expected"}]}}
/// Dies with the process that started it, and is limited as jobs/worker_limits.h says.
int run_worker(const std::filesystem::path& job_folder, const std::string& task_name);

}  // namespace throng::jobs
