// The commands that the service and `throng run` start for themselves.
#pragma once

#include <CLI/CLI.hpp>

#include "jobs/pipeline/confined_work.h"
#include "jobs/pipeline/worker.h"

namespace throng::cli {

/// Adds `throng worker`, which performs the tasks of a job, of a study, and `others`.
void add_worker(CLI::App& app, const jobs::OtherTasks& others);

/// Adds `throng confined`, which performs the service's requests and `others`.
void add_confined(CLI::App& app, const jobs::ConfinedWork& others);

}  // namespace throng::cli
