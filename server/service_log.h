// The service's log: a line per message on a stream or in a file, which can be rotated.
#pragma once

#include <cstdio>
#include <filesystem>

namespace throng::server {

/// The destination of spdlog's default logger, which may outlive the object.
class ServiceLog {
 public:
  /// Makes the default logger write to `file`, or, if that is "", to stdout or stderr. Throws
  /// EnvironmentError if the file cannot be opened.
  ServiceLog(bool as_json, bool to_stdout, const std::filesystem::path& file);

  /// Opens the file at its path again: after it was renamed, lines go to a new file from here on,
  /// and none is lost. Logs a warning and goes on with the old file if that fails. No effect
  /// without a file.
  void reopen() const;

 private:
  std::filesystem::path file_;   ///< absolute; "": none
  std::FILE* stream_ = nullptr;  ///< of the file; open until the process ends
};

}  // namespace throng::server
