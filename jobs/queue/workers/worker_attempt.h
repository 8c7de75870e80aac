// The worker's side of an attempt (jobs/queue/workers/attempts.h).
#pragma once

#include <filesystem>
#include <string>

namespace throng::jobs {

/// Begins the attempt of this index in an array: this process's stdout becomes the attempt's
/// messages, stderr is appended to the task's log, output is staged in the attempt's folder, and
/// the array's variables are set. Returns the task's name. Throws EnvironmentError when the right
/// was taken away, or another process has begun the attempt. Call it before there are threads.
std::string begin_attempt(const std::filesystem::path& job_folder, const std::string& array,
                          int index);

/// Says how the attempt ended and what it has published.
void end_attempt(const std::filesystem::path& job_folder, int exit_code);

}  // namespace throng::jobs
