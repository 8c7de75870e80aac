// The worker: one process, one task. It reports to its supervisor through stdout, one JSON object
// per line, and its exit code (jobs/queue/workers/worker_protocol.h); everything else goes to
// stderr.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>

#include "jobs/pipeline/pipeline.h"

namespace throng::jobs {

/// Tasks that belong to no job's plan, by name (to_string(Task)), or the part of it before a slash:
/// they publish their output in the folder. `name` is the whole name. Throw InputError and
/// EnvironmentError.
using OtherTasks =
    std::map<std::string, std::function<void(const JobFolder& folder, const std::string& name,
                                             const OnTaskProgress& on_progress)>>;

/// Runs the task in the job's folder and returns the process's exit code. Writes
///   {"done":3,"total":30}
/// lines as it goes on, {} lines as signs of life in between and, when it fails,
///   {"error":{"kind":"input"|"environment"|"bug","message":...,"problems":[{"source","where","found","expected"}]}}
/// Dies with the process that started it, and is limited as jobs/queue/confine/worker_limits.h
/// says.
int run_worker(const std::filesystem::path& job_folder, const std::string& task_name,
               const OtherTasks& others = {});

}  // namespace throng::jobs
