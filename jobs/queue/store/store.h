// The durable job queue: one SQLite file in the data folder, open in one server at a time. A change
// marked "Durable" survives a crash of the process and of the machine once its call has returned.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "jobs/queue/store/job_row.h"
#include "jobs/queue/store/state.h"
#include "spec/job/resolved_job.h"

namespace throng::jobs {

/// An event of a job.
struct EventRow {
  std::int64_t seq = 0;    ///< increases over all jobs; never used twice
  std::string job;         ///< id
  std::int64_t at_ms = 0;  ///< Unix time
  std::string type;  ///< "submitted", to_string(JobEvent), "changed", "removed" or record_event()'s
  std::string data_json;
};

/// The store cannot be written now: its files were removed or are locked. It may pass.
class StoreUnavailable : public EnvironmentError {
 public:
  using EnvironmentError::EnvironmentError;
};

/// Safe to use from many threads.
class Store {
 public:
  /// Returns Unix time in milliseconds.
  using Clock = std::function<std::int64_t()>;

  /// Opens or creates the store in `folder`. `clock` defaults to the system clock; `steady` is
  /// passed to ServiceClock. Throws EnvironmentError if another process has it open, if it cannot
  /// be read, or if a newer version of throng wrote it.
  explicit Store(const std::filesystem::path& folder, Clock clock = {}, Clock steady = {});
  ~Store();
  Store(const Store&) = delete;
  Store& operator=(const Store&) = delete;

  /// Queues a job, unless the owner has submitted one with the same key or has reached a limit.
  /// Durable.
  Added add(const NewJob& job);

  /// The job of this id; std::nullopt if there is none.
  std::optional<JobRow> get(const std::string& id) const;
  /// One page of the jobs that meet the filter.
  std::vector<JobRow> list(const JobFilter& filter) const;
  /// The number of jobs of any kind in each state.
  std::map<JobState, std::int64_t> count() const;
  /// The number of queued and of running jobs of each owner that has any, the largest ones first.
  std::vector<OwnerCount> count_by_owner() const;
  /// Jobs that a supervisor may take up: all running ones, then one queued job per owner, namely
  /// the oldest with the owner's highest priority.
  std::vector<JobRow> startable() const;

  /// Applies an event if the job is still in the state and attempt of `row` and next_state() allows
  /// it. Returns the new row; std::nullopt otherwise. Durable.
  std::optional<JobRow> apply(const JobRow& row, JobEvent event,
                              const std::string& error_json = "");

  /// Applies JobEvent::retry unless the job's owner has reached a limit. Durable.
  Retried retry(const JobRow& row, const OwnerLimits& limits);
  /// Disk usage of an owner's jobs as OwnerLimits::max_bytes counts it.
  std::int64_t bytes_of(const std::string& owner) const;

  /// Changes a job's properties. Returns the new row; std::nullopt if there is no such job.
  /// Durable.
  std::optional<JobRow> change(const std::string& id, const JobChange& change);

  /// Stores JobRow::bytes of a job.
  void set_bytes(const std::string& id, std::int64_t bytes);

  /// At most `limit` jobs of any kind that have ended and may be removed (JobRow::keep is false),
  /// in the order of their ends.
  std::vector<JobRow> ended(int limit) const;
  /// The sum of JobRow::bytes of all jobs.
  std::int64_t total_bytes() const;
  /// Deletes the "removed" events that are older than this Unix time. Returns their number.
  int forget_events(std::int64_t before_ms);

  /// Stores the progress of a running attempt; has no effect if the job's state or attempt has
  /// changed. Costs a disk sync: call it at most about once a second.
  void save_progress(const JobRow& row, const std::string& progress_json);

  /// Records an event of a running attempt; has no effect if the job's state or attempt has
  /// changed.
  void record_event(const JobRow& row, const std::string& type, const std::string& data_json);

  /// At most `limit` events with numbers above `after`, in rising order, of one job or of all ("").
  std::vector<EventRow> events(const std::string& job, std::int64_t after, int limit) const;
  /// The number of the newest event; 0 for none.
  std::int64_t last_event() const;

  /// The store's clock: Unix time in milliseconds.
  std::int64_t now_ms() const { return clock_(); }
  /// The clock of the retention rules, in milliseconds (jobs/queue/store/service_clock.h).
  std::int64_t service_ms() const;
  /// Saves service_ms() for the next process. Call it about once a minute.
  void save_service_clock();

  /// Throws EnvironmentError if the store's files were removed or replaced.
  void check_files() const;

  /// Deletes a job and its events and records the event "removed". Returns false if there is no
  /// such job. Durable.
  bool remove(const std::string& id);

 private:
  struct Connections;
  std::unique_ptr<Connections> connections_;
  Clock clock_;
};

}  // namespace throng::jobs
