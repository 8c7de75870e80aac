#include "jobs/queue/slurm/slurm_arrays.h"

#include <utility>

#include "base/error.h"
#include "base/files/resources.h"
#include "jobs/queue/slurm/slurm_batch.h"
#include "jobs/queue/slurm/slurm_submission.h"

namespace throng::jobs {

namespace {

SlurmOptions completed(SlurmOptions options) {
  if (options.command.empty()) options.command = {program_path().string(), "worker"};
  return options;
}

std::string one_line(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  for (auto at = text.find('\n'); at != std::string::npos; at = text.find('\n', at)) {
    text.replace(at, 1, "; ");
  }
  return text;
}

}  // namespace

bool SlurmArrayNames::take(const std::string& array) {
  const std::lock_guard lock(mutex_);
  return names_.insert(array).second;
}

void SlurmArrayNames::give_back(const std::string& array) {
  const std::lock_guard lock(mutex_);
  names_.erase(array);
}

SlurmArrays::SlurmArrays(const SlurmOptions& options, LocalProcessesOptions here)
    : shared_(new SlurmShared{completed(options), SlurmController({.poll_s = options.poll_s})}),
      here_(std::move(here)) {
  shared_->meters = here_.meters();
}

std::vector<TaskResult> SlurmArrays::run(const JobFolder& folder, std::span<const Task> tasks,
                                         const OnProgress& on_progress, std::stop_token stop,
                                         const Share& share) {
  if (tasks.size() == 1 && tasks[0].kind == Task::Kind::publish) {
    return here_.run(folder, tasks, on_progress, std::move(stop), share);
  }
  // The nodes are elsewhere: a relative path means nothing to them.
  const JobFolder absolute(std::filesystem::absolute(folder.path()));
  return SlurmBatch({*shared_, absolute, tasks, on_progress, std::move(stop), share}).run();
}

std::string check_slurm(const SlurmOptions& options) {
  constexpr double kTimeoutS = 15;
  const SlurmAnswer answer = run_slurm(test_submission(options), kTimeoutS);
  if (answer.is_ok) return "";
  if (answer.is_away) return one_line(answer.text);
  throw InputError(Problem{"--executor", "slurm", one_line(answer.text),
                           "sbatch in PATH, and a partition, account, time, memory and gres that "
                           "the cluster has (--slurm-partition and so on)"});
}

}  // namespace throng::jobs
