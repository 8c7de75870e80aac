// CPU time that jobs take on this machine, relative to the reference machine of the estimates;
// learned from jobs that ran here. Nothing but estimates depends on it.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "jobs/queue/dataset/folder.h"
#include "spec/job/spec.h"

namespace throng::jobs {

/// The user's file of what was learned, throng/speed.json in $XDG_CACHE_HOME or ~/.cache; empty if
/// there is neither.
std::filesystem::path user_speed_file();

/// Learns from a job that took `cpu_s` and whose dataset is complete: compares it with the estimate
/// for the people who took part, and keeps a mean over the last jobs in `file`. Faults are ignored,
/// because no job may fail by it.
void learn_machine_speed(const std::filesystem::path& file, const JobFolder& folder,
                         const JobSpec& job, double cpu_s) noexcept;

/// Scales the CPU time in the answer of a dry run by what was learned in `file`, if that can be
/// read, and says so in the estimate's "basis".
void fit_to_machine(nlohmann::json& answer, const std::filesystem::path& file);

}  // namespace throng::jobs
