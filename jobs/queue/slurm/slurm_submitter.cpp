#include "jobs/queue/slurm/slurm_submitter.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <future>

#include "base/error.h"
#include "jobs/queue/slurm/slurm_state.h"
#include "jobs/queue/slurm/slurm_submission.h"
#include "jobs/queue/workers/attempts.h"

namespace throng::jobs {

void SlurmSubmitter::submit_ready() {
  const bool is_submitting =
      std::any_of(arrays_.begin(), arrays_.end(),
                  [](const SlurmArray& array) { return array.submission.has_value(); });
  if (is_submitting || !tasks_.is_one_waiting() || call_.stop.stop_requested()) return;
  if (!refusals_.may_submit() || !call_.shared.controller.queue()->away.empty()) return;
  bool is_enough = false;
  for (auto& [need, tasks] : tasks_.take_ready()) {
    // Another that could not be submitted may have ended its run meanwhile.
    tasks.erase(std::remove_if(tasks.begin(), tasks.end(),
                               [this](std::size_t task) {
                                 return tasks_.result(task).outcome == Outcome::cancelled;
                               }),
                tasks.end());
    for (std::size_t i = 0; i < tasks.size();) {
      if (is_enough) {
        tasks_.wait(tasks[i++]);
        continue;
      }
      const std::size_t end = std::min(tasks.size(), i + refusals_.max_tasks());
      submit(need, {tasks.begin() + static_cast<std::ptrdiff_t>(i),
                    tasks.begin() + static_cast<std::ptrdiff_t>(end)});
      i = end;
      // After a refusal one array shows whether others are accepted.
      is_enough = refusals_.count() > 0;
    }
  }
}

void SlurmSubmitter::submit(const SlurmNeed& need, const std::vector<std::size_t>& tasks) {
  AttemptArray made;
  for (const std::size_t task : tasks) {
    made.attempts.push_back({to_string(call_.tasks[task]), ++tasks_.result(task).attempts});
  }
  made.variables = task_variables(need, call_.shared.options);
  try {
    create_attempts(call_.folder, made);
  } catch (const EnvironmentError& error) {  // the shared disk is full, or gone
    for (const std::size_t task : tasks) {
      ends_.fail(task, {Outcome::environment_error, 0, error.what(), {}});
    }
    return;
  }
  call_.shared.arrays.take(made.name);
  refusals_.begin();
  SlurmArray& array = arrays_.emplace_back();
  array.name = made.name;
  array.nice = nice_value(call_.share.priority());
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    array.entries.emplace_back(tasks[i], i,
                               attempt_folder(call_.folder, made.name, i) / "messages");
  }
  array.submission = call_.shared.controller.run(submission_words(
      call_.folder, made.name, tasks.size(), need, array.nice, call_.shared.options));
}

void SlurmSubmitter::finish(SlurmArray& array) {
  constexpr std::chrono::seconds kNow(0);
  if (!array.submission || array.submission->wait_for(kNow) != std::future_status::ready) return;
  const SlurmAnswer answer = array.submission->get();
  array.submission.reset();
  array.job = answer.is_ok ? read_submission(answer.text) : "";
  if (!array.job.empty()) {
    array.since = steady_now();
    refusals_.accept();
    note_array_job(call_.folder, array.name, array.job);  // or it is found by its name
    return;
  }
  // It may have been accepted although the answer got lost: then its tasks find no folder.
  call_.shared.controller.run_until_answered(
      {"scancel", "--quiet", "--name=" + slurm_job_name(array.name)});
  refusals_.refuse(answer, array.entries.size());
  abandon(array);
}

void SlurmSubmitter::find_number(SlurmArray& array, const SlurmQueue& queue) {
  if (array.submission || queue.asked <= array.since || queue.asked == array.last_look) return;
  array.last_look = queue.asked;
  const auto found = queue.jobs.find(slurm_job_name(array.name));
  if (found != queue.jobs.end()) {
    array.job = found->second;
    note_array_job(call_.folder, array.name, array.job);
    return;
  }
  // Looks at the queue that must miss an array until it counts as gone.
  constexpr int kMissingLooks = 2;
  if (++array.looks_without < kMissingLooks) return;
  abandon(array);
}

// As if its tasks had never been begun.
void SlurmSubmitter::abandon(SlurmArray& array) {
  for (SlurmEntry& entry : array.entries) {
    if (!entry.is_open) continue;
    entry.is_open = false;
    revoke_attempt(call_.folder, array.name, entry.index);
    tasks_.take_back(entry.task);
  }
}

}  // namespace throng::jobs
