// What a worker tells its supervisor: one JSON object per line of its stdout.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "jobs/executor.h"

namespace throng::jobs {

/// Why a worker gives up. `kind` is "input", "environment" or "bug".
struct WorkerError {
  std::string kind;
  std::string message;
  std::vector<Problem> problems;
};

/// One line: a step, an error, or neither when the line is not for us.
struct WorkerMessage {
  std::optional<TaskProgress> progress;
  std::optional<WorkerError> error;
};

/// Lines without line break; always valid UTF-8.
std::string progress_line(const TaskProgress& progress);
std::string error_line(const WorkerError& error);

/// Anything that is not a message (a driver may print) gives an empty one.
WorkerMessage read_worker_message(const std::string& line);

}  // namespace throng::jobs
