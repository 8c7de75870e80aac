// Brings one job from its spec to its dataset. Used by `throng run` and by the server.
#pragma once

#include <cstdint>
#include <functional>
#include <stop_token>
#include <string_view>
#include <vector>

#include "jobs/executor.h"
#include "jobs/folder.h"
#include "jobs/spec.h"

namespace throng::jobs {

/// What a run is at.
enum class Stage { waiting, simulating, rendering, rendered, finished };

std::string_view name_of(Stage stage);

struct RunProgress {
  int run = 0;
  std::uint64_t seed = 0;
  Stage stage = Stage::waiting;
  double simulated_s = 0;  ///< of CaptureSpec::to_s
  double duration_s = 0;
  std::int64_t images_done = 0;  ///< over all cameras
  std::int64_t images_total = 0;
};

/// One entry per run.
using JobProgress = std::vector<RunProgress>;

using OnJobProgress = std::function<void(const JobProgress&)>;

/// Does every task of the job whose output is not there yet. Safe to repeat after any interruption;
/// the result has the same bytes. No other supervisor may be at work in the folder.
/// Throws InputError, EnvironmentError (a worker failed for good: says which and why), Cancelled.
void run_job(const JobFolder& folder, const JobSpec& job, Executor& executor,
             const OnJobProgress& on_progress = {}, std::stop_token stop = {});

}  // namespace throng::jobs
