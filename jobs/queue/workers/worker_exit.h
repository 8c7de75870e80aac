// Why a worker ended, from its messages and its exit status.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "jobs/queue/confine/child_process.h"
#include "jobs/queue/workers/executor.h"
#include "jobs/queue/workers/worker_messages.h"

namespace throng::jobs {

struct EndedWorker {
  ExitStatus status;
  std::optional<WorkerError> error;  ///< what it said itself
  std::string timeout;               ///< why its supervisor killed it; "": it did not
  bool memory_ran_out = false;       ///< the kernel killed processes for memory meanwhile
};

/// Its outcome and message (attempts are not filled in); the message of a worker that died without
/// a word ends with the last lines of its log.
TaskResult task_result(const EndedWorker& end, const std::filesystem::path& log);

}  // namespace throng::jobs
