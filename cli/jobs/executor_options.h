// Options of commands that run jobs: the executor.
#pragma once

#include <CLI/CLI.hpp>

#include "jobs/queue/executors.h"

namespace throng::cli {

/// Adds --executor and the --slurm-... options. `options` must outlive the command.
void add_executor_options(CLI::App& command, jobs::ExecutorOptions& options);

}  // namespace throng::cli
