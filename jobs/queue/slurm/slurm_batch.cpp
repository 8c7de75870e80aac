#include "jobs/queue/slurm/slurm_batch.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <thread>
#include <utility>

#include "base/error.h"

namespace throng::jobs {

namespace fs = std::filesystem;

namespace {

// How late a wish to stop may be noticed.
constexpr std::chrono::milliseconds kTick(100);
constexpr std::chrono::milliseconds kLookPause(500);
// How long a stop waits for workers to end. One that does not has lost its right to publish.
constexpr std::chrono::seconds kMaxWait(8);
// Looks at the queue that must miss an array or a task until it counts as gone.
constexpr int kMissingLooks = 2;

}  // namespace

SlurmBatch::SlurmBatch(SlurmShared& shared, const JobFolder& folder, std::span<const Task> tasks,
                       const Executor::OnProgress& on_progress, std::stop_token stop,
                       const Share& share)
    : shared_(shared),
      options_(shared.options),
      watch_(shared.controller),
      folder_(folder),
      tasks_(tasks),
      on_progress_(on_progress),
      stop_(std::move(stop)),
      share_(share),
      ledgers_(tasks.size()),
      results_(tasks.size()) {}

SlurmBatch::~SlurmBatch() {
  for (const Array& array : arrays_) shared_.arrays.give_back(array.name);
}

std::vector<TaskResult> SlurmBatch::run() {
  adopt();
  Clock::time_point next_look;
  while (true) {
    if (stop_.stop_requested()) {
      if (shared_.leaves_tasks) return leave();
      end_others([](const Task&) { return true; });
    }
    for (Array& array : arrays_) finish_submission(array);
    submit_ready();
    const auto queue = shared_.controller.queue();
    if (Clock::now() >= next_look) {
      look(*queue);
      next_look = Clock::now() + kLookPause;
    }
    cancel_ended();
    drop_closed_arrays();
    say_why_nothing_runs(*queue);
    if (arrays_.empty() && waiting_.empty()) break;
    std::this_thread::sleep_for(kTick);
  }
  wait_for_cancelled();
  return std::move(results_);
}

void SlurmBatch::look(const SlurmQueue& queue) {
  are_messages_due_ = Clock::now() >= next_messages_;
  for (Array& array : arrays_) {
    if (array.job.empty()) find_number(array, queue);
    look_at(array, queue);
    update_nice(array);
  }
  if (are_messages_due_) next_messages_ = Clock::now() + message_pause();
  pending_ = reason_to_wait(queue);
}

std::optional<std::size_t> SlurmBatch::task_named(const std::string& name) const {
  for (std::size_t i = 0; i < tasks_.size(); ++i) {
    if (to_string(tasks_[i]) == name) return i;
  }
  return std::nullopt;
}

// Arrays of an earlier process go on. Attempts in them that nobody wants any more are taken back.
void SlurmBatch::adopt() {
  for (const AttemptArray& found : read_attempts(folder_)) {
    if (shared_.arrays.take(found.name)) adopt(found);
  }
  for (std::size_t i = 0; i < tasks_.size(); ++i) {
    const bool is_taken = std::any_of(arrays_.begin(), arrays_.end(), [&](const Array& array) {
      return std::any_of(array.entries.begin(), array.entries.end(),
                         [&](const Entry& entry) { return entry.task == i; });
    });
    if (!is_taken) waiting_.push_back({i, options_.now()});
  }
}

void SlurmBatch::adopt(const AttemptArray& found) {
  Array& array = arrays_.emplace_back();
  array.name = found.name;
  array.job = noted_array_job(folder_, found.name);
  array.nice = nice_value(share_.priority());
  for (std::size_t i = 0; i < found.attempts.size(); ++i) {
    const fs::path own = attempt_folder(folder_, found.name, i);
    std::error_code none;
    if (!fs::exists(own, none)) continue;  // it has ended
    const auto task = task_named(found.attempts[i].task);
    const bool is_double =
        task && std::any_of(arrays_.begin(), arrays_.end(), [&](const Array& a) {
          return std::any_of(a.entries.begin(), a.entries.end(),
                             [&](const Entry& entry) { return entry.task == *task; });
        });
    if (task && !is_double) {
      array.entries.emplace_back(*task, i, own / "messages");
      results_[*task].attempts = found.attempts[i].number;
      continue;
    }
    revoke_attempt(folder_, array.name, i);
    array.to_cancel.push_back(i);
  }
}

// Submits the tasks that need not rest: one array for all that need the same.
void SlurmBatch::submit_ready() {
  const bool is_submitting = std::any_of(arrays_.begin(), arrays_.end(), [](const Array& array) {
    return array.submission.has_value();
  });
  if (is_submitting || waiting_.empty() || stop_.stop_requested()) return;
  if (Clock::now() < next_submission_) return;
  if (!shared_.controller.queue()->away.empty()) return;
  std::map<SlurmNeed, std::vector<std::size_t>> ready;
  std::deque<Waiting> later;
  const SteadyTime now = options_.now();
  for (const Waiting& waiting : waiting_) {
    if (waiting.from > now) {
      later.push_back(waiting);
      continue;
    }
    const Task& task = tasks_[waiting.task];
    ready[slurm_need(task, share_.memory_mib(task), ledgers_[waiting.task].exhaustions, options_)]
        .push_back(waiting.task);
  }
  waiting_ = std::move(later);
  bool is_enough = false;
  for (auto& [need, tasks] : ready) {
    // Another that could not be submitted may have ended its run meanwhile.
    tasks.erase(std::remove_if(tasks.begin(), tasks.end(),
                               [this](std::size_t task) {
                                 return results_[task].outcome == Outcome::cancelled;
                               }),
                tasks.end());
    for (std::size_t i = 0; i < tasks.size();) {
      if (is_enough) {
        waiting_.push_back({tasks[i++], now});
        continue;
      }
      const std::size_t end = std::min(tasks.size(), i + max_tasks());
      submit(need, {tasks.begin() + static_cast<std::ptrdiff_t>(i),
                    tasks.begin() + static_cast<std::ptrdiff_t>(end)});
      i = end;
      // After a refusal one array shows whether others are accepted.
      is_enough = refusals_ > 0;
    }
  }
}

std::size_t SlurmBatch::max_tasks() const {
  return std::min(max_accepted_, shared_.max_tasks.load());
}

void SlurmBatch::submit(const SlurmNeed& need, const std::vector<std::size_t>& tasks) {
  AttemptArray made;
  for (const std::size_t task : tasks) {
    made.attempts.push_back({to_string(tasks_[task]), ++results_[task].attempts});
  }
  made.variables = task_variables(need, options_);
  try {
    create_attempts(folder_, made);
  } catch (const EnvironmentError& error) {  // the shared disk is full, or gone
    for (const std::size_t task : tasks) {
      fail(task, {Outcome::environment_error, 0, error.what(), {}});
    }
    return;
  }
  shared_.arrays.take(made.name);
  // Tasks that end one by one are submitted together.
  next_submission_ = Clock::now() + steady_seconds(options_.poll_s);
  Array& array = arrays_.emplace_back();
  array.name = made.name;
  array.nice = nice_value(share_.priority());
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    array.entries.emplace_back(tasks[i], i, attempt_folder(folder_, made.name, i) / "messages");
  }
  array.submission = shared_.controller.run(
      submission_words(folder_, made.name, tasks.size(), need, array.nice, options_));
}

void SlurmBatch::finish_submission(Array& array) {
  constexpr std::chrono::seconds kNow(0);
  if (!array.submission || array.submission->wait_for(kNow) != std::future_status::ready) return;
  const SlurmAnswer answer = array.submission->get();
  array.submission.reset();
  array.job = answer.is_ok ? read_submission(answer.text) : "";
  if (!array.job.empty()) {
    array.since = Clock::now();
    refusal_.clear();
    refusals_ = 0;
    max_accepted_ = std::min(kMaxArrayTasks, 2 * max_accepted_);
    note_array_job(folder_, array.name, array.job);  // or it is found by its name
    return;
  }
  // It may have been accepted although the answer got lost: then its tasks find no folder.
  shared_.controller.run_until_answered(
      {"scancel", "--quiet", "--name=" + slurm_job_name(array.name)});
  take_refusal(array, answer);
  abandon(array);
}

// A limit on arrays, or on the tasks of a user, leaves room for smaller ones.
void SlurmBatch::take_refusal(const Array& array, const SlurmAnswer& answer) {
  const std::size_t half = std::max<std::size_t>(1, array.entries.size() / 2);
  refusal_ = answer.is_away ? "" : answer.text.substr(0, answer.text.find('\n'));
  if (is_array_too_large(answer.text) && array.entries.size() > 1) {
    shared_.max_tasks = std::min(shared_.max_tasks.load(), half);
    refusals_ = std::max(refusals_, 1);
    next_submission_ = {};
    return;
  }
  if (!answer.is_away) max_accepted_ = half;
  constexpr int kMaxDoublings = 6;
  const double rest_s = options_.rest_s * std::pow(2.0, std::min(refusals_++, kMaxDoublings));
  next_submission_ = Clock::now() + steady_seconds(rest_s);
}

// The server died between the submission and the note of its number.
void SlurmBatch::find_number(Array& array, const SlurmQueue& queue) {
  if (array.submission || queue.asked <= array.since || queue.asked == array.last_look) return;
  array.last_look = queue.asked;
  const auto found = queue.jobs.find(slurm_job_name(array.name));
  if (found != queue.jobs.end()) {
    array.job = found->second;
    note_array_job(folder_, array.name, array.job);
    return;
  }
  if (++array.looks_without < kMissingLooks) return;
  abandon(array);
}

// As if its tasks had never been begun.
void SlurmBatch::abandon(Array& array) {
  for (Entry& entry : array.entries) {
    if (!entry.is_open) continue;
    entry.is_open = false;
    revoke_attempt(folder_, array.name, entry.index);
    --results_[entry.task].attempts;
    waiting_.push_back({entry.task, options_.now()});
  }
}

void SlurmBatch::update_nice(Array& array) const {
  const int nice = nice_value(share_.priority());
  if (nice == array.nice || array.job.empty()) return;
  array.nice = nice;
  shared_.controller.run_until_answered(
      {"scontrol", "update", "JobId=" + array.job, fmt::format("Nice={}", nice)});
}

// Why the first task that waits does so; "" when one runs.
std::string SlurmBatch::reason_to_wait(const SlurmQueue& queue) const {
  std::string reason;
  for (const Array& array : arrays_) {
    for (const Entry& entry : array.entries) {
      if (!entry.is_open) continue;
      const auto found = queue.tasks.find({array.job, static_cast<int>(entry.index)});
      if (found == queue.tasks.end() || found->second.name != slurm_job_name(array.name)) continue;
      if (interpret_fate(found->second) != SlurmFate::waiting) return "";
      if (reason.empty()) reason = found->second.reason;
    }
  }
  return reason == "None" ? "" : reason;
}

void SlurmBatch::say_why_nothing_runs(const SlurmQueue& queue) {
  std::string reason;
  if (!queue.away.empty()) {
    reason =
        fmt::format("Slurm's controller does not answer ({}); tasks that run go on", queue.away);
  } else if (!refusal_.empty()) {
    reason = fmt::format("Slurm refuses the tasks: {}", refusal_);
  } else if (!pending_.empty()) {
    reason = fmt::format("the tasks wait in Slurm's queue ({})", pending_);
  }
  if (reason == reason_) return;
  reason_ = reason;
  share_.on_wait(reason);
}

void SlurmBatch::drop_closed_arrays() {
  for (auto array = arrays_.begin(); array != arrays_.end();) {
    // An answer of sbatch may still come: scancel follows it.
    if (array->is_open()) {
      ++array;
      continue;
    }
    remove_attempts(folder_, array->name);
    shared_.arrays.give_back(array->name);
    array = arrays_.erase(array);
  }
}

// The next process finds the arrays in the job's folder.
std::vector<TaskResult> SlurmBatch::leave() {
  cancel_ended();
  for (Array& array : arrays_) {
    if (array.submission) array.submission->wait_for(kMaxWait);
    finish_submission(array);
    for (Entry& entry : array.entries) {
      if (!entry.is_open) continue;
      if (!entry.node.empty()) shared_.book.leave(folder_, entry.node);
      results_[entry.task].outcome = Outcome::cancelled;
    }
  }
  for (const Waiting& waiting : waiting_) results_[waiting.task].outcome = Outcome::cancelled;
  return std::move(results_);
}

// So that nothing writes any more in a folder that is going to be removed.
void SlurmBatch::wait_for_cancelled() {
  const Clock::time_point begun = Clock::now();
  while (!cancelled_.empty() && Clock::now() < begun + kMaxWait) {
    const auto queue = shared_.controller.queue();
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
    std::this_thread::sleep_for(kTick);
  }
}

SteadyTime SlurmBatch::after(double seconds) const {
  return options_.now() + steady_seconds(seconds);
}

}  // namespace throng::jobs
