// The messages of a worker that writes them to a file, read as they come.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "jobs/queue/workers/attempts.h"
#include "jobs/queue/workers/worker_messages.h"

namespace throng::jobs {

class MessageFileReader {
 public:
  explicit MessageFileReader(std::filesystem::path path) : path_(std::move(path)) {}

  /// Reads what is new; false when nothing is. Opens the file again, which is when a network file
  /// system asks for what others have written.
  bool read();

  /// Steps among what was read last.
  const std::vector<TaskProgress>& steps() const { return steps_; }
  const std::optional<WorkerError>& error() const { return error_; }
  const std::optional<AttemptEnd>& end() const { return end_; }

 private:
  std::filesystem::path path_;
  std::int64_t offset_ = 0;
  std::string pending_;  ///< a line that has not ended yet
  std::vector<TaskProgress> steps_;
  std::optional<WorkerError> error_;
  std::optional<AttemptEnd> end_;
};

}  // namespace throng::jobs
