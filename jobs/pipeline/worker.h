// Main function of a worker, a process that performs one task. It reports to its supervisor through
// JSON lines on stdout and its exit code (jobs/queue/workers/worker_protocol.h); all other output
// goes to stderr.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>

#include "jobs/pipeline/pipeline.h"

namespace throng::jobs {

/// Tasks outside of a job's plan, by their names (to_string(Task)) up to the first slash. They
/// publish their output in the folder and throw InputError and EnvironmentError; `name` is the
/// whole name.
using OtherTasks =
    std::map<std::string, std::function<void(const JobFolder& folder, const std::string& name,
                                             const OnTaskProgress& on_progress)>>;

/// Performs the task in the job's folder and returns the process's exit code. Writes lines of
/// progress,
///   {"done":3,"total":30}
/// {} as signs of life in between, and on failure
///   {"error":{"kind":"input"|"environment"|"bug","message":...,
///             "problems":[{"source","where","found","expected"}]}}
/// The process ends with its parent and is confined by jobs/queue/confine/worker_limits.h.
int run_worker(const std::filesystem::path& job_folder, const std::string& task_name,
               const OtherTasks& others = {});

}  // namespace throng::jobs
