// The service's log: a line per message on a stream or in a file, which can be rotated.
#pragma once

#include <filesystem>

namespace throng::server {

/// Makes the default log of spdlog write to `file`, or, if that is "", to stdout or stderr. Call it
/// once. Throws EnvironmentError if the file cannot be opened.
void set_up_log(bool as_json, bool to_stdout, const std::filesystem::path& file);

/// Opens the file at its path again: after it was renamed, lines go to a new file from here on, and
/// none is lost. Logs a warning and goes on with the old file if that fails. No effect without a
/// file.
void reopen_log();

}  // namespace throng::server
