// Reads the messages that a worker on another machine appends to a file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "jobs/queue/workers/attempts.h"
#include "jobs/queue/workers/worker_messages.h"

namespace throng::jobs {

/// Follows one file of messages (jobs/queue/workers/attempts.h).
class MessageFileReader {
 public:
  explicit MessageFileReader(std::filesystem::path path) : path_(std::move(path)) {}

  /// Reads new lines; returns false if there are none. Opens the file again, because network file
  /// systems revalidate their caches on open.
  bool read();

  /// The progress messages of the last read().
  const std::vector<TaskProgress>& steps() const { return steps_; }
  const std::optional<WorkerError>& error() const { return error_; }
  const std::optional<AttemptEnd>& end() const { return end_; }

 private:
  std::filesystem::path path_;
  std::int64_t offset_ = 0;
  std::string pending_;  ///< an incomplete line
  std::vector<TaskProgress> steps_;
  std::optional<WorkerError> error_;
  std::optional<AttemptEnd> end_;
};

}  // namespace throng::jobs
