// Messages of a worker to its supervisor: one JSON object per line of its stdout.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "jobs/queue/workers/executor.h"

namespace throng::jobs {

/// The error with which a worker gives up.
struct WorkerError {
  std::string kind;  ///< "input", "environment" or "bug"
  std::string message;
  std::vector<Problem> problems;
};

/// One line: progress, an error, or neither, which still is a sign of life.
struct WorkerMessage {
  std::optional<TaskProgress> progress;
  std::optional<WorkerError> error;
};

/// {"kind", "message", "problems"}.
nlohmann::json to_json(const WorkerError& error);

/// Format one message as a line without line break; always valid UTF-8.
std::string progress_line(const TaskProgress& progress);
std::string error_line(const WorkerError& error);
/// A message without content. Workers send it regularly, because one without messages for too long
/// is considered dead.
std::string sign_of_life_line();

/// Parses a line; anything that is not a message, such as output of a driver, gives an empty one.
WorkerMessage read_worker_message(const std::string& line);

}  // namespace throng::jobs
