// Attempts that run, and how they end.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "jobs/queue/slurm/slurm_batch.h"
#include "jobs/queue/workers/worker_exit.h"
#include "jobs/queue/workers/worker_protocol.h"

namespace throng::jobs {

namespace fs = std::filesystem;

namespace {

// How long the last words of a worker may take to be seen after Slurm says that it has ended.
constexpr std::chrono::seconds kLastWords(10);

}  // namespace

bool SlurmBatch::Array::is_open() const {
  return std::any_of(entries.begin(), entries.end(),
                     [](const Entry& entry) { return entry.is_open; });
}

void SlurmBatch::look_at(Array& array, const SlurmQueue& queue) {
  if (array.job.empty() || queue.asked <= array.since) return;
  take_accounting(array, queue);
  for (Entry& entry : array.entries) {
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

void SlurmBatch::look_at(Array& array, Entry& entry, const SlurmTask& state) {
  const SlurmFate fate = interpret_fate(state);
  if (fate == SlurmFate::waiting) {
    if (!entry.node.empty() && is_requeued(state)) return begin_again(array, entry, state);
    entry.heard = options_.now();  // also one that was suspended
    return;
  }
  follow(entry, state);
  if (take_end(array, entry, state)) return;
  if (fate != SlurmFate::running) {
    if (!entry.ended) entry.ended = options_.now();
    // One that was killed has said what it had to say.
    const bool is_silent =
        fate != SlurmFate::completed && (fate != SlurmFate::failed || state.status.signal != 0);
    if (!is_silent && options_.now() < *entry.ended + kLastWords) return;
    TaskResult result =
        result_of_slurm(state, entry.messages.error(), folder_.log_file(tasks_[entry.task]));
    if (result.outcome == Outcome::succeeded) {
      result = {Outcome::environment_error,
                0,
                fmt::format("Slurm says that the task has ended on node {}, but its last words "
                            "are not in {}: is the folder shared?",
                            state.node, folder_.path().string()),
                {}};
    }
    return end_attempt(array, entry, state, std::move(result), is_blameless(fate));
  }
  const auto since = [this](Clock::time_point then) {
    return std::chrono::duration<double>(options_.now() - then).count();
  };
  std::string timeout;
  if (since(entry.heard) > options_.lease_s) {
    timeout = fmt::format("no sign of life for {} s on node {}", options_.lease_s, state.node);
  } else if (options_.max_task_s > 0 && since(entry.begun) > options_.max_task_s) {
    timeout = fmt::format("the task took longer than {} s", options_.max_task_s);
  }
  if (timeout.empty()) return;
  array.to_cancel.push_back(entry.index);
  end_attempt(array, entry, state,
              task_result({{}, std::nullopt, timeout}, folder_.log_file(tasks_[entry.task])),
              false);
}

// Slurm forgets tasks some minutes after their end (MinJobAge), and all of them with its state.
void SlurmBatch::look_for_absent(Array& array, Entry& entry, const SlurmQueue& queue) {
  if (entry.is_in_accounting) return;
  SlurmTask unknown;
  unknown.node = entry.node;
  read_messages(entry);
  if (take_end(array, entry, unknown)) return;
  if (!entry.absent) entry.absent = queue.asked;
  entry.is_in_accounting = *entry.absent != queue.asked && !array.accounting;
}

// One sacct asks for all tasks of an array that two looks have missed.
void SlurmBatch::take_accounting(Array& array, const SlurmQueue& queue) {
  constexpr std::chrono::seconds kNow(0);
  if (!array.accounting) {
    if (std::none_of(array.entries.begin(), array.entries.end(),
                     [](const Entry& entry) { return entry.is_open && entry.is_in_accounting; })) {
      return;
    }
    array.accounting =
        shared_.controller.run({"sacct", "-n", "-P", "-X", "-j", array.job, "-o", kAccountFormat});
    return;
  }
  if (array.accounting->wait_for(kNow) != std::future_status::ready) return;
  const SlurmAnswer answer = array.accounting->get();
  array.accounting.reset();
  std::map<int, SlurmTask> known;
  if (answer.is_ok) known = read_accounting(answer.text, slurm_job_name(array.name));
  for (Entry& entry : array.entries) {
    if (!entry.is_open || !entry.is_in_accounting) continue;
    entry.is_in_accounting = false;
    entry.absent = queue.asked;
    const auto found = known.find(static_cast<int>(entry.index));
    take_account(array, entry, found == known.end() ? std::nullopt : std::optional(found->second));
  }
}

void SlurmBatch::take_account(Array& array, Entry& entry, const std::optional<SlurmTask>& account) {
  SlurmTask gone = account.value_or(SlurmTask{});
  if (gone.node.empty()) gone.node = entry.node;
  if (account) {
    const SlurmFate fate = interpret_fate(gone);
    if (fate != SlurmFate::running && fate != SlurmFate::waiting) look_at(array, entry, gone);
    return;
  }
  gone.state = "BOOT_FAIL";
  end_attempt(array, entry, gone,
              {Outcome::environment_error, 0, "lost: Slurm does not know the task", {}}, true);
}

// Slurm has ended the task and will begin it under the same number: with a new right to publish, it
// keeps its place in the queue.
void SlurmBatch::begin_again(Array& array, Entry& entry, const SlurmTask& state) {
  SlurmTask before = state;
  before.node = entry.node;
  read_messages(entry);
  if (take_end(array, entry, before)) {
    array.to_cancel.push_back(entry.index);
    return;
  }
  const std::string message = fmt::format("lost on node {}: Slurm begins it again", entry.node);
  if (!renew_attempt(folder_, array.name, entry.index)) {
    before.state = "PREEMPTED";
    return end_attempt(array, entry, before, {Outcome::environment_error, 0, message, {}}, true);
  }
  note_end(array, entry, "lost", message);
  entry.messages = MessageFileReader(attempt_folder(folder_, array.name, entry.index) / "messages");
  entry.node.clear();
  entry.ended.reset();
}

// Notes where it runs, and reads what it says.
void SlurmBatch::follow(Entry& entry, const SlurmTask& state) {
  if (entry.node.empty() && !state.node.empty()) {
    entry.node = state.node;
    entry.begun = entry.heard = options_.now();
    shared_.book.begin(folder_, entry.node);
  }
  // An end is seen at the next look; steps and signs of life are not worth a file system's time.
  if (are_messages_due_ || interpret_fate(state) != SlurmFate::running) read_messages(entry);
}

// However many tasks run, their files are opened at a bounded rate, and often enough that none is
// taken for dead.
SlurmBatch::Clock::duration SlurmBatch::message_pause() const {
  constexpr std::chrono::milliseconds kMinPause(500);
  constexpr std::chrono::milliseconds kPerTask(50);
  constexpr double kPerLease = 4;
  const Clock::duration pause =
      std::max<Clock::duration>(kMinPause, kPerTask * shared_.book.running());
  return std::min(pause, steady_seconds(options_.lease_s / kPerLease));
}

void SlurmBatch::read_messages(Entry& entry) {
  if (!entry.messages.read()) return;
  entry.heard = options_.now();
  if (!on_progress_) return;
  for (TaskProgress step : entry.messages.steps()) {
    step.node = entry.node;
    on_progress_(tasks_[entry.task], step);
  }
}

// Whether it has said how it ended, and what it has published is seen from here.
bool SlurmBatch::take_end(Array& array, Entry& entry, const SlurmTask& state) {
  const std::optional<AttemptEnd>& end = entry.messages.end();
  if (!end) return false;
  if (end->code != worker_succeeded) {
    SlurmTask said = state;
    said.state = "FAILED";
    said.status = {end->code, 0};
    end_attempt(array, entry, said,
                result_of_slurm(said, entry.messages.error(), folder_.log_file(tasks_[entry.task])),
                false);
    return true;
  }
  if (!entry.ended) entry.ended = options_.now();
  if (has_published(*end)) {
    succeed(array, entry, state.node);
  } else if (options_.now() > *entry.ended + std::chrono::duration<double>(options_.visibility_s)) {
    end_attempt(array, entry, state,
                {Outcome::environment_error,
                 0,
                 fmt::format("what node {} has published is not in {}: is the folder shared?",
                             state.node, folder_.path().string()),
                 {}},
                false);
  }
  return true;
}

// Network file systems remember for a minute that a file was not there; a list of the folder makes
// them ask again.
bool SlurmBatch::has_published(const AttemptEnd& end) const {
  return std::all_of(end.published.begin(), end.published.end(), [&](const std::string& path) {
    const fs::path file = folder_.path() / path;
    std::error_code none;
    if (fs::exists(file, none)) return true;
    for ([[maybe_unused]] const auto& entry : fs::directory_iterator(file.parent_path(), none)) {
      break;
    }
    return fs::exists(file, none);
  });
}

void SlurmBatch::close(Array& array, Entry& entry, const std::string& outcome,
                       const std::string& message) {
  entry.is_open = false;
  note_end(array, entry, outcome, message);
}

void SlurmBatch::note_end(const Array& array, const Entry& entry, const std::string& outcome,
                          const std::string& message) {
  if (entry.node.empty()) return;
  const double seconds = entry.messages.end()
                             ? entry.messages.end()->seconds
                             : std::chrono::duration<double>(options_.now() - entry.begun).count();
  if (shared_.meters != nullptr) shared_.meters->note(tasks_[entry.task], outcome, seconds);
  shared_.book.leave(folder_, entry.node);
  shared_.book.end(folder_,
                   {to_string(tasks_[entry.task]), results_[entry.task].attempts, entry.node,
                    fmt::format("{}_{}", array.job, entry.index), outcome, seconds, message});
}

void SlurmBatch::succeed(Array& array, Entry& entry, const std::string& node) {
  if (entry.node.empty() && !node.empty()) entry.node = node;
  close(array, entry, to_string(Outcome::succeeded), "");
  // Now rather than with all others at the end of the stage, which would wait for it.
  revoke_attempt(folder_, array.name, entry.index);
}

void SlurmBatch::end_attempt(Array& array, Entry& entry, const SlurmTask& state, TaskResult result,
                             bool is_blameless) {
  // From here on it cannot publish: only then may another attempt begin.
  revoke_attempt(folder_, array.name, entry.index);
  close(array, entry, is_blameless ? "lost" : to_string(result.outcome), result.message);
  if (is_blameless) {
    array.to_cancel.push_back(entry.index);  // Slurm may hold it
    return lose(entry.task, std::move(result), state);
  }
  if (result.outcome == Outcome::out_of_memory) ++ledgers_[entry.task].exhaustions;
  fail(entry.task, std::move(result));
}

// Lets the task rest and submits it again, or gives it up, and with it the tasks of its run. A job
// that is wrong is given up as a whole.
void SlurmBatch::fail(std::size_t task, TaskResult result) {
  const int attempts = results_[task].attempts;
  const bool is_wrong = result.outcome == Outcome::input_error;
  if (!is_wrong && attempts < options_.attempts) {
    constexpr double kLonger = 4;
    waiting_.push_back({task, after(options_.rest_s * std::pow(kLonger, attempts - 1))});
    return;
  }
  result.attempts = attempts;
  results_[task] = std::move(result);
  const int run = tasks_[task].run;
  end_others([&](const Task& other) { return is_wrong || other.run == run; });
}

// The attempt counts for nothing, unless that happens all the time.
void SlurmBatch::lose(std::size_t task, TaskResult result, const SlurmTask& state) {
  const bool is_preempted = interpret_fate(state) == SlurmFate::preempted;
  if (!is_preempted && ++ledgers_[task].losses >= options_.max_losses) {
    return fail(task, std::move(result));
  }
  --results_[task].attempts;
  waiting_.push_back({task, after(options_.rest_s)});
}

// One scancel per array, for all that were ended since the last one. As long as its number is not
// known, tasks find no right to publish.
void SlurmBatch::cancel_ended() {
  for (Array& array : arrays_) {
    if (array.to_cancel.empty()) continue;
    // The number alone may be another's by now.
    std::vector<std::string> command = {"scancel", "--quiet",
                                        "--name=" + slurm_job_name(array.name)};
    for (const std::size_t index : array.to_cancel) {
      command.push_back(fmt::format("{}_{}", array.job, index));
    }
    array.to_cancel.clear();
    if (!array.job.empty()) shared_.controller.run_until_answered(std::move(command));
  }
}

void SlurmBatch::end_others(const std::function<bool(const Task&)>& condition) {
  const auto gone = std::remove_if(waiting_.begin(), waiting_.end(), [&](const Waiting& waiting) {
    if (!condition(tasks_[waiting.task])) return false;
    results_[waiting.task].outcome = Outcome::cancelled;
    return true;
  });
  waiting_.erase(gone, waiting_.end());
  for (Array& array : arrays_) {
    std::vector<std::string> ended;
    for (Entry& entry : array.entries) {
      if (!entry.is_open || !condition(tasks_[entry.task])) continue;
      revoke_attempt(folder_, array.name, entry.index);
      ended.push_back(fmt::format("{}_{}", array.job, entry.index));
      if (!entry.node.empty()) {
        cancelled_.emplace_back(array.job, static_cast<int>(entry.index));
      }
      results_[entry.task].outcome = Outcome::cancelled;
      close(array, entry, to_string(Outcome::cancelled), "");
    }
    if (ended.empty()) continue;
    // By name also where the number is not known yet: those that begin find no right to publish.
    if (!array.is_open()) ended.clear();
    if (array.is_open() && array.job.empty()) continue;
    ended.insert(ended.begin(), {"scancel", "--quiet", "--name=" + slurm_job_name(array.name)});
    shared_.controller.run_until_answered(std::move(ended));
    shared_.controller.poll_next();
  }
}

}  // namespace throng::jobs
