#include "jobs/queue/slurm/slurm_ends.h"

#include <fmt/core.h>

#include <algorithm>
#include <optional>
#include <thread>
#include <utility>

#include "jobs/queue/slurm/slurm_state.h"
#include "jobs/queue/slurm/slurm_submission.h"
#include "jobs/queue/workers/attempts.h"

namespace throng::jobs {

void SlurmEnds::succeed(SlurmArray& array, SlurmEntry& entry, const std::string& node) {
  if (entry.node.empty() && !node.empty()) entry.node = node;
  close(array, entry, to_string(Outcome::succeeded), "");
  // Now rather than with all others at the end of the stage, which would wait for it.
  revoke_attempt(call_.folder, array.name, entry.index);
}

void SlurmEnds::end_attempt(SlurmArray& array, SlurmEntry& entry, const SlurmTask& state,
                            TaskResult result, bool is_blameless) {
  // From here on it cannot publish: only then may another attempt begin.
  revoke_attempt(call_.folder, array.name, entry.index);
  close(array, entry, is_blameless ? "lost" : to_string(result.outcome), result.message);
  if (!is_blameless) return fail(entry.task, std::move(result));
  array.to_cancel.push_back(entry.index);  // Slurm may hold it
  const bool is_preempted = interpret_fate(state) == SlurmFate::preempted;
  end_others(tasks_.lose(entry.task, std::move(result), is_preempted));
}

void SlurmEnds::fail(std::size_t task, TaskResult result) {
  end_others(tasks_.fail(task, std::move(result)));
}

void SlurmEnds::close(SlurmArray& array, SlurmEntry& entry, const std::string& outcome,
                      const std::string& message) {
  entry.is_open = false;
  note_end(array, entry, outcome, message);
}

void SlurmEnds::note_end(const SlurmArray& array, const SlurmEntry& entry,
                         const std::string& outcome, const std::string& message) {
  if (entry.node.empty()) return;
  const double seconds =
      entry.messages.end()
          ? entry.messages.end()->seconds
          : std::chrono::duration<double>(call_.shared.options.now() - entry.begun).count();
  if (call_.shared.meters != nullptr) {
    call_.shared.meters->note(call_.tasks[entry.task], outcome, seconds);
  }
  call_.shared.book.leave(call_.folder, entry.node);
  call_.shared.book.end(
      call_.folder,
      {to_string(call_.tasks[entry.task]), tasks_.result(entry.task).attempts, entry.node,
       fmt::format("{}_{}", array.job, entry.index), outcome, seconds, message});
}

void SlurmEnds::end_others(const SlurmTasks::Condition& condition) {
  if (!condition) return;
  tasks_.cancel_waiting(condition);
  for (SlurmArray& array : arrays_) {
    std::vector<std::string> ended;
    for (SlurmEntry& entry : array.entries) {
      if (!entry.is_open || !condition(call_.tasks[entry.task])) continue;
      revoke_attempt(call_.folder, array.name, entry.index);
      ended.push_back(fmt::format("{}_{}", array.job, entry.index));
      if (!entry.node.empty()) {
        cancelled_.emplace_back(array.job, static_cast<int>(entry.index));
      }
      tasks_.result(entry.task).outcome = Outcome::cancelled;
      close(array, entry, to_string(Outcome::cancelled), "");
    }
    if (ended.empty()) continue;
    // By name also where the number is not known yet: those that begin find no right to publish.
    if (!array.is_open()) ended.clear();
    if (array.is_open() && array.job.empty()) continue;
    ended.insert(ended.begin(), {"scancel", "--quiet", "--name=" + slurm_job_name(array.name)});
    call_.shared.controller.run_until_answered(std::move(ended));
    call_.shared.controller.poll_next();
  }
}

// As long as the number of an array is not known, its tasks find no right to publish.
void SlurmEnds::cancel_ended() {
  for (SlurmArray& array : arrays_) {
    if (array.to_cancel.empty()) continue;
    // The number alone may be another's by now.
    std::vector<std::string> command = {"scancel", "--quiet",
                                        "--name=" + slurm_job_name(array.name)};
    for (const std::size_t index : array.to_cancel) {
      command.push_back(fmt::format("{}_{}", array.job, index));
    }
    array.to_cancel.clear();
    if (!array.job.empty()) call_.shared.controller.run_until_answered(std::move(command));
  }
}

void SlurmEnds::wait_for_cancelled() {
  const SteadyTime begun = steady_now();
  while (!cancelled_.empty() && steady_now() < begun + kMaxSlurmWait) {
    const auto queue = call_.shared.controller.queue();
    if (!queue->away.empty()) return;
    if (queue->asked > begun) {
      const bool is_one_running =
          std::any_of(cancelled_.begin(), cancelled_.end(), [&](const SlurmQueue::Key& key) {
            const auto found = queue->tasks.find(key);
            return found != queue->tasks.end() &&
                   interpret_fate(found->second) == SlurmFate::running;
          });
      if (!is_one_running) return;
    }
    std::this_thread::sleep_for(kSlurmTick);
  }
}

}  // namespace throng::jobs
