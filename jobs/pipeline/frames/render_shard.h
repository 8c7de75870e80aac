// Frames of a shard: rendered, labeled, written.
#pragma once

#include <filesystem>
#include <stop_token>

#include "jobs/queue/dataset/folder.h"
#include "jobs/queue/workers/executor.h"
#include "spec/job/plan.h"
#include "spec/job/spec.h"

namespace throng::jobs {

/// Renders and labels the frames of a shard: work/run000/shard0000/. Progress in images. Throws as
/// all tasks (jobs/pipeline/pipeline.h).
void render_shard(const JobFolder& folder, const JobSpec& job,
                  const std::filesystem::path& scenarios, const Shard& shard,
                  const OnTaskProgress& on_progress = {}, const std::stop_token& stop = {});

}  // namespace throng::jobs
