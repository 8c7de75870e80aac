#include "jobs/queue/slurm/slurm_tasks.h"

#include <algorithm>
#include <cmath>

namespace throng::jobs {

void SlurmTasks::wait(std::size_t task, double rest_s) {
  waiting_.push_back({task, call_.shared.options.now() + steady_seconds(rest_s)});
}

std::map<SlurmNeed, std::vector<std::size_t>> SlurmTasks::take_ready() {
  const SlurmOptions& options = call_.shared.options;
  std::map<SlurmNeed, std::vector<std::size_t>> ready;
  std::deque<Waiting> later;
  const SteadyTime now = options.now();
  for (const Waiting& waiting : waiting_) {
    if (waiting.from > now) {
      later.push_back(waiting);
      continue;
    }
    const Task& task = call_.tasks[waiting.task];
    ready[slurm_need(task, call_.share.memory_mib(task), ledgers_[waiting.task].exhaustions,
                     options)]
        .push_back(waiting.task);
  }
  waiting_ = std::move(later);
  return ready;
}

void SlurmTasks::cancel_waiting(const Condition& condition) {
  const auto gone = std::remove_if(waiting_.begin(), waiting_.end(), [&](const Waiting& waiting) {
    if (!condition(call_.tasks[waiting.task])) return false;
    results_[waiting.task].outcome = Outcome::cancelled;
    return true;
  });
  waiting_.erase(gone, waiting_.end());
}

void SlurmTasks::take_back(std::size_t task, double rest_s) {
  --results_[task].attempts;
  wait(task, rest_s);
}

SlurmTasks::Condition SlurmTasks::fail(std::size_t task, TaskResult result) {
  if (result.outcome == Outcome::out_of_memory) ++ledgers_[task].exhaustions;
  const SlurmOptions& options = call_.shared.options;
  const int attempts = results_[task].attempts;
  const bool is_wrong = result.outcome == Outcome::input_error;
  if (!is_wrong && attempts < options.attempts) {
    constexpr double kLonger = 4;
    wait(task, options.rest_s * std::pow(kLonger, attempts - 1));
    return {};
  }
  result.attempts = attempts;
  results_[task] = std::move(result);
  return [is_wrong, run = call_.tasks[task].run](const Task& other) {
    return is_wrong || other.run == run;
  };
}

SlurmTasks::Condition SlurmTasks::lose(std::size_t task, TaskResult result, bool is_preempted) {
  const SlurmOptions& options = call_.shared.options;
  if (!is_preempted && ++ledgers_[task].losses >= options.max_losses) {
    return fail(task, std::move(result));
  }
  take_back(task, options.rest_s);
  return {};
}

}  // namespace throng::jobs
