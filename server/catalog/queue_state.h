// State of the queue that the parts of the service share: active jobs, pause, and notifications.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "base/text/prometheus.h"
#include "jobs/queue/store/store.h"
#include "server/catalog/event_counter.h"

namespace throng::server {

/// Safe to use from many threads.
class QueueState {
 public:
  /// The store must outlive this object.
  explicit QueueState(jobs::Store& store) : store_(store) {}

  // --- events of jobs

  /// Applies an event as Store::apply() does and notifies the waiting threads.
  std::optional<jobs::JobRow> apply(const jobs::JobRow& row, jobs::JobEvent event,
                                    const std::string& error_json = "");
  /// Queues a job again as Store::retry() does and notifies the waiting threads.
  jobs::Retried retry(const jobs::JobRow& row, const jobs::OwnerLimits& limits);
  /// Records an event of a job; logs a warning if it cannot be recorded.
  void record_event(const jobs::JobRow& row, const std::string& type, const std::string& data_json);
  /// Wakes the threads that wait for events.
  void notify_event();
  /// A number that changes with every event and with progress.
  std::uint64_t revision() const { return revision_; }
  /// The counter of all events.
  EventCounter& event_counter() const { return event_counter_; }

  // --- active jobs, which a supervisor works on

  /// Makes the job that `start` returns active, unless the queue is paused. The active jobs are
  /// locked during the call of `start`. Returns std::nullopt if there is no job.
  std::optional<jobs::JobRow> begin(const std::function<std::optional<jobs::JobRow>()>& start,
                                    const std::stop_source& stop);
  /// Removes a job from the active ones.
  void finish(const std::string& id);
  std::vector<jobs::JobRow> active_jobs() const;
  /// The priority of an active job; 0 for other jobs.
  int priority_of(const std::string& id) const;
  void set_priority(const std::string& id, int priority);
  /// Sets the reason why no task of an active job runs; "" if one does.
  void set_waiting(const std::string& id, const std::string& reason);
  /// Requests a stop of a job.
  void stop_work_on(const std::string& id);
  /// Requests a stop of a job and blocks until it is no longer active. Throws EnvironmentError if
  /// that takes too long.
  void end_work_on(const std::string& id);
  void set_progress(const jobs::JobRow& row, std::string progress_json);
  /// Adds the values that are not in the store: the newest progress, and why the job waits.
  void complete(jobs::JobRow& row) const;
  /// A lock; no job becomes active while it is held.
  std::unique_lock<std::mutex> hold() const { return std::unique_lock(mutex_); }

  // --- waiting of the runner

  /// Notifies the runner that a job was queued or may be started now.
  void notify_queued();
  /// Blocks until a job may be started; returns false after a stop request.
  bool wait_for_queued(const std::stop_token& stop);
  /// Blocks while the queue is paused; returns false after a stop request.
  bool wait_while_paused(const std::stop_token& stop);
  /// Blocks for a time or until a stop request.
  void wait(const std::stop_token& stop, std::chrono::milliseconds time);

  /// Pauses the queue for a reason, or resumes it (""). A pause stops the active jobs; the output
  /// that they have published is kept.
  void pause(const std::string& reason);
  /// The reason of the pause; "" if the queue is not paused.
  std::string paused() const;

  /// From now on no job is started; active jobs go on.
  void drain();
  bool is_draining() const;

  /// Metrics of the jobs that have ended since the start, by state and cause.
  std::string ended_jobs() const { return ended_.text(); }

 private:
  void count_end(const jobs::JobRow& ended);

  struct Active {
    jobs::JobRow row;  ///< carries the newest progress and priority
    std::stop_source stop;
  };

  jobs::Store& store_;
  mutable std::mutex mutex_;
  std::condition_variable_any changed_;  ///< a job was queued or ended, or the pause changed
  bool queued_ = true;                   ///< a job may be ready to start; guarded by mutex_
  std::string paused_;                   ///< guarded by mutex_
  bool is_draining_ = false;             ///< guarded by mutex_
  PrometheusMeter ended_{"throng_jobs_ended_total",
                         "Jobs that have ended since the start, by state and cause of failure."};
  std::map<std::string, Active> active_;  ///< by id; guarded by mutex_
  mutable EventCounter event_counter_;
  std::atomic<std::uint64_t> revision_ = 0;
};

}  // namespace throng::server
