// Profile of a job's rendering: every worker writes its own clock beside its log, and the caller
// adds them up. Nothing of it is part of the dataset.
#pragma once

#include <cstdint>
#include <string>

#include "base/compute/stage_clock.h"
#include "jobs/queue/dataset/folder.h"
#include "spec/job/plan.h"
#include "spec/job/spec.h"

namespace throng::jobs {

/// Set in the environment of workers that shall measure themselves.
inline constexpr const char* kProfileVariable = "THRONG_PROFILE";

/// Whether this process shall.
bool is_profiling();

/// A worker's times, for `images` images: logs/TASK.profile.json.
void write_profile(const JobFolder& folder, const Task& task, const StageClock& clock,
                   std::int64_t images);

/// A table of all tasks' times by stage, dearest first, as text; says so when there are none.
std::string profile_table(const JobFolder& folder, const JobSpec& job);

}  // namespace throng::jobs
