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
#include "jobs/queue/store/state.h"
#include "spec/job/resolved_job.h"

namespace throng::jobs {

/// Kind of a queued job's result.
enum class JobKind { dataset, calibration, study };

inline constexpr std::array kJobKinds = {JobKind::dataset, JobKind::calibration, JobKind::study};

std::string_view to_string(JobKind kind);

/// One job as stored.
struct JobRow {
  std::string id;
  JobKind kind = JobKind::dataset;
  std::string name;
  JobState state = JobState::queued;
  int attempt = 0;              ///< how often a supervisor has started or resumed it
  std::string spec_json;        ///< the job with all defaults; a calibration's or study's request
  std::string progress_json;    ///< last saved progress; "" for none
  std::string error_json;       ///< why it failed; "" for none
  std::int64_t created_ms = 0;  ///< Unix time
  std::int64_t started_ms = 0;  ///< 0: not yet
  std::int64_t ended_ms = 0;    ///< 0: not yet
  int priority = 0;             ///< higher values start first
  std::vector<std::string> labels = {};
  std::string owner = {};         ///< id of the key that submitted it; "" without keys
  std::int64_t bytes = 0;         ///< size of its files on disk, as last measured
  bool keep = false;              ///< excluded from retention
  std::int64_t kept_from_ms = 0;  ///< when it ended, by Store::service_ms(); 0: not yet
  SceneLoad load = {};            ///< ResolvedJob::load()
  /// Hashes of the scenarios that it was resolved from, by the first parts of their ids; "{}" for
  /// none.
  std::string sources_json = "{}";
  std::int64_t planned_bytes = 0;  ///< estimated size of its files when it is done
  std::string waiting_for = {};    ///< not stored: why no task of it runs although it is its turn
  /// Not stored: the state in the file is not a known one. The job counts as failed and can only be
  /// removed.
  bool is_damaged = false;
};

/// Properties of a job that may be changed at any time.
struct JobChange {
  int priority = 0;
  std::vector<std::string> labels = {};
  bool keep = false;
};

/// Limits on all jobs of an owner together; another job is refused once one is reached.
struct OwnerLimits {
  int max_active = 0;  ///< number of queued and running jobs; 0: unlimited
  /// Total JobRow::bytes, of queued and running jobs at least JobRow::planned_bytes; 0: unlimited.
  std::int64_t max_bytes = 0;
};

/// A job to be queued.
struct NewJob {
  std::string name;
  std::string spec_json = "{}";
  JobKind kind = JobKind::dataset;
  int priority = 0;
  std::vector<std::string> labels = {};
  std::string owner = {};
  /// Idempotency key: another submission of the owner with the same key returns the first one's
  /// job; "" for none.
  std::string key = {};
  /// Hash of the request; it distinguishes a repeated submission from a key that is used twice.
  std::string hash = {};
  OwnerLimits limits = {};          ///< checked against the owner's jobs without this one
  SceneLoad load = {};              ///< ResolvedJob::load()
  std::string sources_json = "{}";  ///< JobRow::sources_json
  std::int64_t planned_bytes = 0;   ///< JobRow::planned_bytes
};

/// Jobs of an owner in a state.
struct OwnerCount {
  std::string owner;  ///< JobRow::owner
  JobState state = JobState::queued;
  std::int64_t jobs = 0;
};

/// Result of Store::retry().
struct Retried {
  std::optional<JobRow> row = {};  ///< none if the job's state has changed or allows no retry
  std::string over_quota = {};     ///< the limit that the owner has reached; "" for none
};

/// Result of Store::add().
struct Added {
  JobRow row;                   ///< empty if over_quota is set
  bool is_new = true;           ///< false: `row` is the job of an earlier submission with this key
  bool is_equal = true;         ///< false: the earlier submission had another NewJob::hash
  std::string over_quota = {};  ///< the limit that the owner has reached; "" for none
};

/// Jobs with this label are visible to all keys.
inline constexpr const char* kSharedLabel = "shared";

/// Criteria and page of Store::list().
struct JobFilter {
  JobKind kind = JobKind::dataset;
  std::vector<JobState> states = {};  ///< empty: any
  std::string label = {};             ///< "": any
  std::string name_part = {};         ///< substring of the name, case ignored; "": any
  bool oldest_first = false;          ///< false: newest first
  std::string after = {};             ///< last id of the previous page; "": first page
  int limit = 50;
  std::optional<std::string> visible_to = {};  ///< only jobs of this owner and shared ones
  bool with_spec = true;                       ///< false: JobRow::spec_json stays empty
  /// The page ends with the row at which the texts of its rows have as many bytes (text_bytes()).
  std::size_t max_text_bytes = std::numeric_limits<std::size_t>::max();
};

/// Size of the texts of a row.
std::size_t text_bytes(const JobRow& row);

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
