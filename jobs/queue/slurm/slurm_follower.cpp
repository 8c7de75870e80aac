#include "jobs/queue/slurm/slurm_follower.h"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <future>
#include <map>
#include <string>
#include <utility>

#include "jobs/queue/slurm/slurm_state.h"
#include "jobs/queue/slurm/slurm_submission.h"
#include "jobs/queue/workers/attempts.h"
#include "jobs/queue/workers/worker_exit.h"
#include "jobs/queue/workers/worker_protocol.h"

namespace throng::jobs {

namespace fs = std::filesystem;

namespace {

// How long the last words of a worker may take to be seen after Slurm says that it has ended.
constexpr std::chrono::seconds kLastWords(10);

// Network file systems remember for a minute that a file was not there; a list of the folder makes
// them ask again.
bool has_published(const JobFolder& folder, const AttemptEnd& end) {
  return std::all_of(end.published.begin(), end.published.end(), [&](const std::string& path) {
    const fs::path file = folder.path() / path;
    std::error_code none;
    if (fs::exists(file, none)) return true;
    for ([[maybe_unused]] const auto& entry : fs::directory_iterator(file.parent_path(), none)) {
      break;
    }
    return fs::exists(file, none);
  });
}

// However many tasks run, their files are opened at a bounded rate, and often enough that none is
// taken for dead.
SteadyTime::duration message_pause(const SlurmShared& shared) {
  constexpr std::chrono::milliseconds kMinPause(500);
  constexpr std::chrono::milliseconds kPerTask(50);
  constexpr double kPerLease = 4;
  const SteadyTime::duration pause =
      std::max<SteadyTime::duration>(kMinPause, kPerTask * shared.book.running());
  return std::min(pause, steady_seconds(shared.options.lease_s / kPerLease));
}

}  // namespace

void SlurmFollower::look(std::list<SlurmArray>& arrays, const SlurmQueue& queue) {
  are_messages_due_ = steady_now() >= next_messages_;
  for (SlurmArray& array : arrays) look_at(array, queue);
  if (are_messages_due_) next_messages_ = steady_now() + message_pause(call_.shared);
}

void SlurmFollower::look_at(SlurmArray& array, const SlurmQueue& queue) {
  if (array.job.empty() || queue.asked <= array.since) return;
  take_accounting(array, queue);
  for (SlurmEntry& entry : array.entries) {
    if (!entry.is_open) continue;
    const auto found = queue.tasks.find({array.job, static_cast<int>(entry.index)});
    // Numbers of jobs come again when a controller has lost its state.
    if (found == queue.tasks.end() || found->second.name != slurm_job_name(array.name)) {
      look_for_absent(array, entry, queue);
    } else {
      entry.absent.reset();
      look_at(array, entry, found->second);
    }
  }
}

void SlurmFollower::look_at(SlurmArray& array, SlurmEntry& entry, const SlurmTask& state) {
  const SlurmOptions& options = call_.shared.options;
  const SlurmFate fate = interpret_fate(state);
  if (fate == SlurmFate::waiting) {
    if (!entry.node.empty() && is_requeued(state)) return begin_again(array, entry, state);
    entry.heard = options.now();  // also one that was suspended
    return;
  }
  follow(entry, state);
  if (take_end(array, entry, state)) return;
  if (fate != SlurmFate::running) {
    if (!entry.ended) entry.ended = options.now();
    // One that was killed has said what it had to say.
    const bool is_silent =
        fate != SlurmFate::completed && (fate != SlurmFate::failed || state.status.signal != 0);
    if (!is_silent && options.now() < *entry.ended + kLastWords) return;
    TaskResult result = result_of_slurm(state, entry.messages.error(),
                                        call_.folder.log_file(call_.tasks[entry.task]));
    if (result.outcome == Outcome::succeeded) {
      result = {Outcome::environment_error,
                0,
                fmt::format("Slurm says that the task has ended on node {}, but its last words "
                            "are not in {}: is the folder shared?",
                            state.node, call_.folder.path().string()),
                {}};
    }
    return ends_.end_attempt(array, entry, state, std::move(result), is_blameless(fate));
  }
  const auto since = [&](SteadyTime then) {
    return std::chrono::duration<double>(options.now() - then).count();
  };
  std::string timeout;
  if (since(entry.heard) > options.lease_s) {
    timeout = fmt::format("no sign of life for {} s on node {}", options.lease_s, state.node);
  } else if (options.max_task_s > 0 && since(entry.begun) > options.max_task_s) {
    timeout = fmt::format("the task took longer than {} s", options.max_task_s);
  }
  if (timeout.empty()) return;
  array.to_cancel.push_back(entry.index);
  ends_.end_attempt(
      array, entry, state,
      task_result({{}, std::nullopt, timeout}, call_.folder.log_file(call_.tasks[entry.task])),
      false);
}

// Slurm forgets tasks some minutes after their end (MinJobAge), and all of them with its state.
void SlurmFollower::look_for_absent(SlurmArray& array, SlurmEntry& entry, const SlurmQueue& queue) {
  if (entry.is_in_accounting) return;
  SlurmTask unknown;
  unknown.node = entry.node;
  read_messages(entry);
  if (take_end(array, entry, unknown)) return;
  if (!entry.absent) entry.absent = queue.asked;
  entry.is_in_accounting = *entry.absent != queue.asked && !array.accounting;
}

// One sacct asks for all tasks of an array that two looks have missed.
void SlurmFollower::take_accounting(SlurmArray& array, const SlurmQueue& queue) {
  constexpr std::chrono::seconds kNow(0);
  if (!array.accounting) {
    if (std::none_of(array.entries.begin(), array.entries.end(), [](const SlurmEntry& entry) {
          return entry.is_open && entry.is_in_accounting;
        })) {
      return;
    }
    array.accounting = call_.shared.controller.run(
        {"sacct", "-n", "-P", "-X", "-j", array.job, "-o", kAccountFormat});
    return;
  }
  if (array.accounting->wait_for(kNow) != std::future_status::ready) return;
  const SlurmAnswer answer = array.accounting->get();
  array.accounting.reset();
  std::map<int, SlurmTask> known;
  if (answer.is_ok) known = read_accounting(answer.text, slurm_job_name(array.name));
  for (SlurmEntry& entry : array.entries) {
    if (!entry.is_open || !entry.is_in_accounting) continue;
    entry.is_in_accounting = false;
    entry.absent = queue.asked;
    const auto found = known.find(static_cast<int>(entry.index));
    take_account(array, entry, found == known.end() ? std::nullopt : std::optional(found->second));
  }
}

void SlurmFollower::take_account(SlurmArray& array, SlurmEntry& entry,
                                 const std::optional<SlurmTask>& account) {
  SlurmTask gone = account.value_or(SlurmTask{});
  if (gone.node.empty()) gone.node = entry.node;
  if (account) {
    const SlurmFate fate = interpret_fate(gone);
    if (fate != SlurmFate::running && fate != SlurmFate::waiting) look_at(array, entry, gone);
    return;
  }
  gone.state = "BOOT_FAIL";
  ends_.end_attempt(array, entry, gone,
                    {Outcome::environment_error, 0, "lost: Slurm does not know the task", {}},
                    true);
}

// Slurm has ended the task and will begin it under the same number: with a new right to publish, it
// keeps its place in the queue.
void SlurmFollower::begin_again(SlurmArray& array, SlurmEntry& entry, const SlurmTask& state) {
  SlurmTask before = state;
  before.node = entry.node;
  read_messages(entry);
  if (take_end(array, entry, before)) {
    array.to_cancel.push_back(entry.index);
    return;
  }
  const std::string message = fmt::format("lost on node {}: Slurm begins it again", entry.node);
  if (!renew_attempt(call_.folder, array.name, entry.index)) {
    before.state = "PREEMPTED";
    return ends_.end_attempt(array, entry, before, {Outcome::environment_error, 0, message, {}},
                             true);
  }
  ends_.note_end(array, entry, "lost", message);
  entry.messages =
      MessageFileReader(attempt_folder(call_.folder, array.name, entry.index) / "messages");
  entry.node.clear();
  entry.ended.reset();
}

// Notes where it runs, and reads what it says.
void SlurmFollower::follow(SlurmEntry& entry, const SlurmTask& state) {
  if (entry.node.empty() && !state.node.empty()) {
    entry.node = state.node;
    entry.begun = entry.heard = call_.shared.options.now();
    call_.shared.book.begin(call_.folder, entry.node);
  }
  // An end is seen at the next look; steps and signs of life are not worth a file system's time.
  if (are_messages_due_ || interpret_fate(state) != SlurmFate::running) read_messages(entry);
}

void SlurmFollower::read_messages(SlurmEntry& entry) {
  if (!entry.messages.read()) return;
  entry.heard = call_.shared.options.now();
  if (!call_.on_progress) return;
  for (TaskProgress step : entry.messages.steps()) {
    step.node = entry.node;
    call_.on_progress(call_.tasks[entry.task], step);
  }
}

// Whether it has said how it ended, and what it has published is seen from here.
bool SlurmFollower::take_end(SlurmArray& array, SlurmEntry& entry, const SlurmTask& state) {
  const std::optional<AttemptEnd>& end = entry.messages.end();
  if (!end) return false;
  if (end->code != worker_succeeded) {
    SlurmTask said = state;
    said.state = "FAILED";
    said.status = {end->code, 0};
    ends_.end_attempt(array, entry, said,
                      result_of_slurm(said, entry.messages.error(),
                                      call_.folder.log_file(call_.tasks[entry.task])),
                      false);
    return true;
  }
  const SlurmOptions& options = call_.shared.options;
  if (!entry.ended) entry.ended = options.now();
  if (has_published(call_.folder, *end)) {
    ends_.succeed(array, entry, state.node);
  } else if (options.now() > *entry.ended + std::chrono::duration<double>(options.visibility_s)) {
    ends_.end_attempt(array, entry, state,
                      {Outcome::environment_error,
                       0,
                       fmt::format("what node {} has published is not in {}: is the folder shared?",
                                   state.node, call_.folder.path().string()),
                       {}},
                      false);
  }
  return true;
}

}  // namespace throng::jobs
