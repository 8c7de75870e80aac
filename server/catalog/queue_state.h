// State of the queue shared by the parts of the service: the active jobs, whether the queue is
// paused, and the signals that something has happened.
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
#include <vector>

#include "jobs/queue/store/store.h"
#include "server/catalog/event_counter.h"

namespace throng::server {

/// Safe to use from many threads.
class QueueState {
 public:
  /// The store must outlive it.
  explicit QueueState(jobs::Store& store) : store_(store) {}

  // --- what happens to jobs

  /// Changes a job's state and records the event; nothing when it is in another state than `row`.
  std::optional<jobs::JobRow> apply(const jobs::JobRow& row, jobs::JobEvent event,
                                    const std::string& error_json = "");
  /// Queues a job again that has ended, within its owner's limits.
  jobs::Retried retry(const jobs::JobRow& row, const jobs::OwnerLimits& limits);
  /// Records an event of a job. That it cannot be recorded is only logged.
  void record_event(const jobs::JobRow& row, const std::string& type, const std::string& data_json);
  /// Wakes those who wait for events.
  void notify_event();
  /// Changes with every event and with progress.
  std::uint64_t revision() const { return revision_; }
  /// Rings with every event.
  EventCounter& event_counter() const { return event_counter_; }

  // --- the jobs that are being worked on

  /// Begins to work on the job that `start` returns, unless the queue is paused. Nobody else looks
  /// at the active jobs meanwhile. Nothing when there is none.
  std::optional<jobs::JobRow> begin(const std::function<std::optional<jobs::JobRow>()>& start,
                                    const std::stop_source& stop);
  /// Nobody works on the job any more.
  void finish(const std::string& id);
  /// The jobs that are being worked on.
  std::vector<jobs::JobRow> active_jobs() const;
  /// The priority of a job that is being worked on; 0 for others.
  int priority_of(const std::string& id) const;
  void set_priority(const std::string& id, int priority);
  /// Why no task of the job runs although it is being worked on; "" when one does.
  void set_waiting(const std::string& id, const std::string& reason);
  /// Asks for the end of the work on a job and returns when nobody works on it any more. Throws
  /// EnvironmentError when that takes too long.
  void end_work_on(const std::string& id);
  void set_progress(const jobs::JobRow& row, std::string progress_json);
  /// Adds what only this process knows: the newest progress, and why the job waits.
  void complete(jobs::JobRow& row) const;
  /// As long as it is held no work is begun.
  std::unique_lock<std::mutex> hold() const { return std::unique_lock(mutex_); }

  // --- what the runner waits for

  /// A job was queued, or may be begun now.
  void notify_queued();
  /// Until a job may be begun; false when a stop is requested.
  bool wait_for_queued(const std::stop_token& stop);
  /// Until the queue does not rest; false when a stop is requested.
  bool wait_while_paused(const std::stop_token& stop);
  /// For so long, or until a stop is requested.
  void wait(const std::stop_token& stop, std::chrono::milliseconds time);

  /// Pauses the queue for a reason, or resumes it (""). The active jobs are stopped: what they have
  /// published stays.
  void pause(const std::string& reason);
  /// Why the queue is paused; "" when it is not.
  std::string paused() const;

 private:
  struct Active {
    jobs::JobRow row;  ///< carries the newest progress and priority
    std::stop_source stop;
  };

  jobs::Store& store_;
  mutable std::mutex mutex_;
  std::condition_variable_any changed_;   ///< something was queued, a job ended, a pause
  bool queued_ = true;                    ///< there may be something to do; guarded by mutex_
  std::string paused_;                    ///< guarded by mutex_
  std::map<std::string, Active> active_;  ///< by id; guarded by mutex_
  mutable EventCounter event_counter_;
  std::atomic<std::uint64_t> revision_ = 0;
};

}  // namespace throng::server
