// Messages of a worker to its supervisor: one JSON object per line of its stdout.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "jobs/queue/workers/executor.h"

namespace throng::jobs {

/// Why a worker gives up. `kind` is "input", "environment" or "bug".
struct WorkerError {
  std::string kind;
  std::string message;
  std::vector<Problem> problems;
};

/// One line: a step, an error, or neither: then it is at least a sign of life.
struct WorkerMessage {
  std::optional<TaskProgress> progress;
  std::optional<WorkerError> error;
};

/// Lines without line break; always valid UTF-8.
std::string progress_line(const TaskProgress& progress);
std::string error_line(const WorkerError& error);
/// Says that the worker is there. One that is silent for too long is taken for dead.
std::string sign_of_life_line();

/// Anything that is not a message (a driver may print) gives an empty one.
WorkerMessage read_worker_message(const std::string& line);

}  // namespace throng::jobs
