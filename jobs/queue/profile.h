// Profile of a job's rendering: every worker writes the times of its stages beside its log, and
// `throng run --profile` adds them up. The profile is no part of the dataset.
#pragma once

#include <cstdint>
#include <string>

#include "base/compute/stage_clock.h"
#include "jobs/queue/dataset/folder.h"
#include "spec/job/plan.h"
#include "spec/job/spec.h"

namespace throng::jobs {

/// Environment variable that makes workers measure their stages; any value counts.
inline constexpr const char* kProfileVariable = "THRONG_PROFILE";

/// Whether $THRONG_PROFILE is set for this process.
bool is_profiling();

/// Writes logs/TASK.profile.json: CPU and wall time per stage, over `images` images. Throws
/// EnvironmentError.
void write_profile(const JobFolder& folder, const Task& task, const StageClock& clock,
                   std::int64_t images);

/// A text table of the mean times per image by stage, over all render tasks, greatest CPU time
/// first; a sentence that says so if no task was measured.
std::string profile_table(const JobFolder& folder, const JobSpec& job);

}  // namespace throng::jobs
