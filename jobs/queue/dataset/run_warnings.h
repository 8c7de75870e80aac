// Warnings of a job's runs, kept beside the outputs of their tasks for the end of the job.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "jobs/queue/dataset/folder.h"

namespace throng::jobs {

/// Keeps the texts of a task's warnings beside its output, a trace or figures. Throws
/// EnvironmentError.
void keep_warnings(const std::filesystem::path& output, const std::vector<std::string>& texts);

/// The warnings of the first `runs` runs of a job, each text once: "run000: ...". Files that
/// cannot be read are left out.
std::vector<std::string> kept_warnings(const JobFolder& folder, int runs);

}  // namespace throng::jobs
