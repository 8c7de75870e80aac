// The worker's side of an attempt (jobs/queue/workers/attempts.h).
#pragma once

#include <filesystem>
#include <string>

namespace throng::jobs {

/// Starts the attempt of this index in an array: redirects this process's stdout to the attempt's
/// messages and stderr to the task's log, stages output in the attempt's folder, and sets the
/// array's environment variables. Returns the task's name. Throws EnvironmentError if the attempt
/// was revoked or another process has started it. Call it before any thread is started.
std::string begin_attempt(const std::filesystem::path& job_folder, const std::string& array,
                          int index);

/// Writes the line of AttemptEnd: exit code, duration and published paths.
void end_attempt(const std::filesystem::path& job_folder, int exit_code);

}  // namespace throng::jobs
