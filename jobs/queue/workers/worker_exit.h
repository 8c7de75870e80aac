// Outcome of a worker process, from its messages and its exit status.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "jobs/queue/confine/child_process.h"
#include "jobs/queue/workers/executor.h"
#include "jobs/queue/workers/worker_messages.h"

namespace throng::jobs {

/// Evidence about a worker that has ended.
struct EndedWorker {
  ExitStatus status;
  std::optional<WorkerError> error;  ///< error message of the worker
  std::string timeout;               ///< why the supervisor killed it; "" if it did not
  bool memory_ran_out = false;       ///< the kernel killed a process for memory while it ran
};

/// Outcome and message of a worker; TaskResult::attempts is not set. If the worker died without an
/// error message, the result's message ends with the last lines of the log.
TaskResult task_result(const EndedWorker& end, const std::filesystem::path& log);

}  // namespace throng::jobs
