// The work on one study: each of its runs is a task, so that others get their turn in between.
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <stop_token>

#include "jobs/queue/workers/executor.h"

namespace throng::server {

/// {"stage": "simulating" | "summing up" | "finished", "runs_done", "runs_total", "cells": [[...]]
/// (finished runs per case and policy), "remaining_s": number or null}
using OnStudyProgress = std::function<void(const nlohmann::json& progress)>;

/// Simulates the runs that have no result in the study's folder, and writes its report. Results of
/// another version of the program are removed first. `share` need not say how much memory tasks
/// take. Throws Cancelled when `stop` asks, InputError and EnvironmentError.
void work_on_study(const std::filesystem::path& folder, jobs::Executor& executor, jobs::Share share,
                   const OnStudyProgress& on_progress, const std::stop_token& stop);

}  // namespace throng::server
