// The tasks of one call of SlurmArrays::run(), from their submission to their end.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <future>
#include <list>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "base/compute/steady_time.h"
#include "jobs/queue/slurm/message_file_reader.h"
#include "jobs/queue/slurm/slurm_arrays.h"
#include "jobs/queue/slurm/slurm_submission.h"
#include "jobs/queue/workers/attempts.h"
#include "jobs/queue/workers/executor.h"

namespace throng::jobs {

/// One call of SlurmArrays::run(). Use from one thread; all arguments must outlive it.
class SlurmBatch {
 public:
  SlurmBatch(SlurmShared& shared, const JobFolder& folder, std::span<const Task> tasks,
             const Executor::OnProgress& on_progress, std::stop_token stop, const Share& share);
  ~SlurmBatch();
  SlurmBatch(const SlurmBatch&) = delete;
  SlurmBatch& operator=(const SlurmBatch&) = delete;

  std::vector<TaskResult> run();

 private:
  using Clock = std::chrono::steady_clock;

  /// Counters of a task.
  struct Ledger {
    int losses = 0;       ///< attempts lost through no fault of the task
    int exhaustions = 0;  ///< attempts that ran out of memory
  };

  struct Waiting {
    std::size_t task;
    Clock::time_point from;  ///< not to be submitted earlier
  };

  /// An attempt that was submitted.
  struct Entry {
    Entry(std::size_t its_task, std::size_t its_index, const std::filesystem::path& messages_file)
        : task(its_task), index(its_index), messages(messages_file) {}
    std::size_t task;   ///< index in tasks_
    std::size_t index;  ///< index in its array
    MessageFileReader messages;
    std::string node = {};                         ///< "" until it was seen running
    Clock::time_point begun = {};                  ///< when it was first seen running
    Clock::time_point heard = {};                  ///< time of the last message, or when suspended
    std::optional<Clock::time_point> ended = {};   ///< since when Slurm reports its end
    std::optional<Clock::time_point> absent = {};  ///< since when squeue does not list it
    bool is_in_accounting = false;                 ///< sacct was asked for it
    bool is_open = true;
  };

  struct Array {
    std::string name = {};
    std::string job = {};  ///< number of the array job; "" until it is known
    std::optional<std::future<SlurmAnswer>> submission = {};
    std::optional<std::future<SlurmAnswer>> accounting = {};  ///< answer of sacct, if asked
    std::vector<std::size_t> to_cancel = {};                  ///< indices, for the next scancel
    Clock::time_point since = Clock::now();  ///< earlier answers of squeue are ignored
    int looks_without = 0;                   ///< number of looks that did not find its name
    Clock::time_point last_look = {};
    int nice = 0;
    std::list<Entry> entries = {};

    bool is_open() const;
  };

  // Recovery.
  void adopt();
  void adopt(const AttemptArray& found);
  std::optional<std::size_t> task_named(const std::string& name) const;

  // Submission.
  void submit_ready();
  void submit(const SlurmNeed& need, const std::vector<std::size_t>& tasks);
  std::size_t max_tasks() const;
  void take_refusal(const Array& array, const SlurmAnswer& answer);
  void finish_submission(Array& array);
  void find_number(Array& array, const SlurmQueue& queue);
  void abandon(Array& array);
  void update_nice(Array& array) const;

  // Attempts that run.
  void look(const SlurmQueue& queue);
  void look_at(Array& array, const SlurmQueue& queue);
  void look_at(Array& array, Entry& entry, const SlurmTask& state);
  void look_for_absent(Array& array, Entry& entry, const SlurmQueue& queue);
  void take_accounting(Array& array, const SlurmQueue& queue);
  void take_account(Array& array, Entry& entry, const std::optional<SlurmTask>& account);
  void begin_again(Array& array, Entry& entry, const SlurmTask& state);
  void follow(Entry& entry, const SlurmTask& state);
  Clock::duration message_pause() const;
  void read_messages(Entry& entry);
  bool take_end(Array& array, Entry& entry, const SlurmTask& state);
  bool has_published(const AttemptEnd& end) const;

  // Their ends.
  void succeed(Array& array, Entry& entry, const std::string& node);
  void end_attempt(Array& array, Entry& entry, const SlurmTask& state, TaskResult result,
                   bool is_blameless);
  void fail(std::size_t task, TaskResult result);
  void lose(std::size_t task, TaskResult result, const SlurmTask& state);
  void end_others(const std::function<bool(const Task&)>& condition);
  void close(Array& array, Entry& entry, const std::string& outcome, const std::string& message);
  void note_end(const Array& array, const Entry& entry, const std::string& outcome,
                const std::string& message);
  void cancel_ended();
  void drop_closed_arrays();
  std::vector<TaskResult> leave();
  void wait_for_cancelled();

  std::string reason_to_wait(const SlurmQueue& queue) const;
  void say_why_nothing_runs(const SlurmQueue& queue);
  SteadyTime after(double seconds) const;

  SlurmShared& shared_;
  const SlurmOptions& options_;
  SlurmController::Watch watch_;
  const JobFolder& folder_;
  std::span<const Task> tasks_;
  const Executor::OnProgress& on_progress_;
  std::stop_token stop_;
  const Share& share_;
  std::deque<Waiting> waiting_;
  std::list<Array> arrays_;
  std::vector<Ledger> ledgers_;
  std::vector<TaskResult> results_;
  std::string refusal_;  ///< refusal of the last submission; "" if it was accepted
  int refusals_ = 0;     ///< consecutive refusals
  std::size_t max_accepted_ = kMaxArrayTasks;
  Clock::time_point next_submission_ = {};
  Clock::time_point next_messages_ = {};
  bool are_messages_due_ = false;           ///< in this look
  std::string pending_;                     ///< reason_to_wait() of the last look
  std::string reason_;                      ///< reason last passed to Share::on_wait
  std::vector<SlurmQueue::Key> cancelled_;  ///< attempts whose workers may still run
};

}  // namespace throng::jobs
