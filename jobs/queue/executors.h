// Table of the available executors by name (option --executor).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "jobs/queue/slurm/slurm_options.h"
#include "jobs/queue/workers/executor.h"
#include "jobs/queue/workers/local_processes.h"

namespace throng::jobs {

/// The chosen executor and the options of every kind; each kind reads its own.
struct ExecutorOptions {
  std::string name = "local";
  LocalProcessesOptions local = {};
  SlurmOptions slurm = {};
};

/// One row of the table: name, help text, factory and check.
struct ExecutorKind {
  const char* name;
  const char* help;  ///< tells users where tasks run
  std::unique_ptr<Executor> (*make)(const ExecutorOptions& options);
  /// Checks the options before any task runs, for Slurm by a question to its controller. Throws
  /// InputError if they are refused. Returns why they could not be checked; "" if they are
  /// accepted.
  std::string (*check)(const ExecutorOptions& options);
};

/// All kinds; the default comes first.
const std::vector<ExecutorKind>& executor_kinds();

/// The kind of this name. Throws InputError for an unknown name.
const ExecutorKind& executor_kind(const std::string& name);

}  // namespace throng::jobs
