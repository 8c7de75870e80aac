// Options of commands that work jobs off: on which machines.
#pragma once

#include <CLI/CLI.hpp>

#include "jobs/queue/executors.h"

namespace throng::cli {

/// --executor and the --slurm-... options.
void add_executor_options(CLI::App& command, jobs::ExecutorOptions& options);

}  // namespace throng::cli
