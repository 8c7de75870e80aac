#include "jobs/queue/executors.h"

#include <fmt/core.h>

#include <algorithm>

#include "base/error.h"
#include "jobs/queue/slurm/slurm_arrays.h"

namespace throng::jobs {

const std::vector<ExecutorKind>& executor_kinds() {
  static const std::vector<ExecutorKind> kinds = {
      {"local", "processes on this machine",
       [](const ExecutorOptions& options) -> std::unique_ptr<Executor> {
         return std::make_unique<LocalProcesses>(options.local);
       },
       [](const ExecutorOptions&) { return std::string(); }},
      {"slurm", "array jobs of a Slurm cluster that shares the folder (docs/cluster.md)",
       [](const ExecutorOptions& options) -> std::unique_ptr<Executor> {
         return std::make_unique<SlurmArrays>(options.slurm, options.local);
       },
       [](const ExecutorOptions& options) { return check_slurm(options.slurm); }}};
  return kinds;
}

const ExecutorKind& executor_kind(const std::string& name) {
  const auto& kinds = executor_kinds();
  const auto found = std::find_if(kinds.begin(), kinds.end(),
                                  [&](const ExecutorKind& kind) { return name == kind.name; });
  if (found != kinds.end()) return *found;
  std::string names;
  for (const ExecutorKind& kind : kinds)
    names += (names.empty() ? "" : " or ") + std::string(kind.name);
  throw InputError(Problem{"--executor", "", fmt::format("\"{}\"", name), names});
}

}  // namespace throng::jobs
