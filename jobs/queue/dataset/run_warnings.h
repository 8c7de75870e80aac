// Warnings of a job's runs, stored beside the outputs of their tasks and shown at the end of the
// job.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "jobs/queue/dataset/folder.h"

namespace throng::jobs {

/// Writes the warnings of a task to OUTPUT.warnings.json, where `output` is its trace or metrics.
/// Throws EnvironmentError.
void keep_warnings(const std::filesystem::path& output, const std::vector<std::string>& texts);

/// Reads what keep_warnings() wrote for a task; nothing if there is no such file, or none that can
/// be read.
std::vector<std::string> task_warnings(const std::filesystem::path& output);

/// Reads the warnings of the first `runs` runs of a job. Each text is returned once, with the first
/// run that has it: "run000: ...". Skips files that cannot be read.
std::vector<std::string> kept_warnings(const JobFolder& folder, int runs);

}  // namespace throng::jobs
