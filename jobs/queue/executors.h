// The executors that there are, by the names that users give them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "jobs/queue/slurm/slurm_options.h"
#include "jobs/queue/workers/executor.h"
#include "jobs/queue/workers/local_processes.h"

namespace throng::jobs {

struct ExecutorOptions {
  std::string name = "local";
  LocalProcessesOptions local = {};
  SlurmOptions slurm = {};
};

struct ExecutorKind {
  const char* name;
  const char* help;  ///< where tasks run
  std::unique_ptr<Executor> (*make)(const ExecutorOptions& options);
  /// Asks whether it can work with these options. Throws InputError; returns why there is no answer
  /// for now, "" when all is well.
  std::string (*check)(const ExecutorOptions& options);
};

/// All of them, the default first.
const std::vector<ExecutorKind>& executor_kinds();

/// Throws InputError for a name that there is not.
const ExecutorKind& executor_kind(const std::string& name);

}  // namespace throng::jobs
