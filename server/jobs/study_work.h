// Work on one study: each of its runs is a task, so that other jobs can run in between.
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <stop_token>

#include "jobs/queue/workers/executor.h"

namespace throng::server {

/// Receives {"stage": "simulating" | "summing up" | "finished", "runs_done", "runs_total", "cells":
/// [[...]] (number of finished runs per case and policy), "remaining_s": number or null}.
using OnStudyProgress = std::function<void(const nlohmann::json& progress)>;

/// Simulates the runs that have no result in the study's folder, and writes its report. First
/// removes results of other versions of the program. Sets Share::memory_mib itself. Throws
/// InputError, EnvironmentError, and Cancelled after a request by `stop`.
void work_on_study(const std::filesystem::path& folder, jobs::Executor& executor, jobs::Share share,
                   const OnStudyProgress& on_progress, const std::stop_token& stop);

}  // namespace throng::server
