#include "jobs/queue/slurm/slurm_batch.h"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <list>
#include <optional>
#include <span>
#include <thread>
#include <utility>

#include "jobs/queue/slurm/slurm_state.h"
#include "jobs/queue/slurm/slurm_submission.h"
#include "jobs/queue/workers/attempts.h"

namespace throng::jobs {

namespace fs = std::filesystem;

namespace {

// Why the first task that waits does so; "" when one runs.
std::string reason_to_wait(const std::list<SlurmArray>& arrays, const SlurmQueue& queue) {
  std::string reason;
  for (const SlurmArray& array : arrays) {
    for (const SlurmEntry& entry : array.entries) {
      if (!entry.is_open) continue;
      const auto found = queue.tasks.find({array.job, static_cast<int>(entry.index)});
      if (found == queue.tasks.end() || found->second.name != slurm_job_name(array.name)) continue;
      if (interpret_fate(found->second) != SlurmFate::waiting) return "";
      if (reason.empty()) reason = found->second.reason;
    }
  }
  return reason == "None" ? "" : reason;
}

void update_nice(const SlurmCall& call, SlurmArray& array) {
  const int nice = nice_value(call.share.priority());
  if (nice == array.nice || array.job.empty()) return;
  array.nice = nice;
  call.shared.controller.run_until_answered(
      {"scontrol", "update", "JobId=" + array.job, fmt::format("Nice={}", nice)});
}

std::optional<std::size_t> task_named(std::span<const Task> tasks, const std::string& name) {
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    if (to_string(tasks[i]) == name) return i;
  }
  return std::nullopt;
}

void adopt(const AttemptArray& found, const SlurmCall& call, SlurmTasks& tasks,
           std::list<SlurmArray>& arrays) {
  SlurmArray& array = arrays.emplace_back();
  array.name = found.name;
  array.job = noted_array_job(call.folder, found.name);
  array.nice = nice_value(call.share.priority());
  for (std::size_t i = 0; i < found.attempts.size(); ++i) {
    const fs::path own = attempt_folder(call.folder, found.name, i);
    std::error_code none;
    if (!fs::exists(own, none)) continue;  // it has ended
    const auto task = task_named(call.tasks, found.attempts[i].task);
    const bool is_double = task && std::any_of(arrays.begin(), arrays.end(),
                                               [&](const SlurmArray& a) { return a.holds(*task); });
    if (task && !is_double) {
      array.entries.emplace_back(*task, i, own / "messages");
      tasks.result(*task).attempts = found.attempts[i].number;
      continue;
    }
    revoke_attempt(call.folder, array.name, i);
    array.to_cancel.push_back(i);
  }
}

// Arrays of an earlier process go on. Attempts in them that nobody wants any more are taken back.
void adopt_all(const SlurmCall& call, SlurmTasks& tasks, std::list<SlurmArray>& arrays) {
  for (const AttemptArray& found : read_attempts(call.folder)) {
    if (call.shared.arrays.take(found.name)) adopt(found, call, tasks, arrays);
  }
  for (std::size_t i = 0; i < call.tasks.size(); ++i) {
    const bool is_taken = std::any_of(arrays.begin(), arrays.end(),
                                      [&](const SlurmArray& array) { return array.holds(i); });
    if (!is_taken) tasks.wait(i);
  }
}

}  // namespace

SlurmBatch::SlurmBatch(SlurmCall call)
    : call_(std::move(call)),
      watch_(call_.shared.controller),
      tasks_(call_),
      ends_(call_, tasks_, arrays_),
      follower_(call_, ends_),
      submitter_(call_, tasks_, arrays_, ends_) {}

SlurmBatch::~SlurmBatch() {
  for (const SlurmArray& array : arrays_) call_.shared.arrays.give_back(array.name);
}

std::vector<TaskResult> SlurmBatch::run() {
  constexpr std::chrono::milliseconds kLookPause(500);
  adopt_all(call_, tasks_, arrays_);
  SteadyTime next_look;
  while (true) {
    if (call_.stop.stop_requested()) {
      if (call_.shared.leaves_tasks) return leave();
      ends_.end_others([](const Task&) { return true; });
    }
    for (SlurmArray& array : arrays_) submitter_.finish(array);
    submitter_.submit_ready();
    const auto queue = call_.shared.controller.queue();
    if (steady_now() >= next_look) {
      look(*queue);
      next_look = steady_now() + kLookPause;
    }
    ends_.cancel_ended();
    drop_closed_arrays();
    say_why_nothing_runs(*queue);
    if (arrays_.empty() && !tasks_.is_one_waiting()) break;
    std::this_thread::sleep_for(kSlurmTick);
  }
  ends_.wait_for_cancelled();
  return tasks_.take_results();
}

void SlurmBatch::look(const SlurmQueue& queue) {
  for (SlurmArray& array : arrays_) {
    if (array.job.empty()) submitter_.find_number(array, queue);
  }
  follower_.look(arrays_, queue);
  for (SlurmArray& array : arrays_) update_nice(call_, array);
  pending_ = reason_to_wait(arrays_, queue);
}

void SlurmBatch::say_why_nothing_runs(const SlurmQueue& queue) {
  std::string reason;
  if (!queue.away.empty()) {
    reason =
        fmt::format("Slurm's controller does not answer ({}); tasks that run go on", queue.away);
  } else if (!submitter_.refusal().empty()) {
    reason = fmt::format("Slurm refuses the tasks: {}", submitter_.refusal());
  } else if (!pending_.empty()) {
    reason = fmt::format("the tasks wait in Slurm's queue ({})", pending_);
  }
  if (reason == reason_) return;
  reason_ = reason;
  call_.share.on_wait(reason);
}

void SlurmBatch::drop_closed_arrays() {
  for (auto array = arrays_.begin(); array != arrays_.end();) {
    // An answer of sbatch may still come: scancel follows it.
    if (array->is_open()) {
      ++array;
      continue;
    }
    remove_attempts(call_.folder, array->name);
    call_.shared.arrays.give_back(array->name);
    array = arrays_.erase(array);
  }
}

// The next process finds the arrays in the job's folder.
std::vector<TaskResult> SlurmBatch::leave() {
  ends_.cancel_ended();
  for (SlurmArray& array : arrays_) {
    if (array.submission) array.submission->wait_for(kMaxSlurmWait);
    submitter_.finish(array);
    for (SlurmEntry& entry : array.entries) {
      if (!entry.is_open) continue;
      if (!entry.node.empty()) call_.shared.book.leave(call_.folder, entry.node);
      tasks_.result(entry.task).outcome = Outcome::cancelled;
    }
  }
  tasks_.cancel_waiting([](const Task&) { return true; });
  return tasks_.take_results();
}

}  // namespace throng::jobs
