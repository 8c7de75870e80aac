// The durable queue: one SQLite file in the data folder, one server at a time. Results
// that a call has returned survive the death of the process and of the machine.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "jobs/queue/store/state.h"

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
  int attempt = 0;              ///< how often a supervisor took it up
  std::string spec_json;        ///< the job with all defaults; a calibration's or study's request
  std::string progress_json;    ///< the last that was saved; "" for none
  std::string error_json;       ///< why it failed; "" for none
  std::int64_t created_ms = 0;  ///< Unix time
  std::int64_t started_ms = 0;  ///< 0: not yet
  std::int64_t ended_ms = 0;    ///< 0: not yet
  int priority = 0;             ///< higher values start first
  std::vector<std::string> labels = {};
  std::string owner = {};         ///< of whom it is; "" for nobody in particular
  std::int64_t bytes = 0;         ///< that its files take on disk, as last measured
  bool keep = false;              ///< never to be removed for its age
  std::int64_t kept_from_ms = 0;  ///< its end by Store::service_ms(); 0: not yet
  int people = 0;                 ///< ResolvedJob::people()
  std::string waiting_for = {};   ///< not stored: why nobody works on it although it is its turn
  /// Not stored: its state in the store is none. It counts as failed and can only be removed.
  bool is_damaged = false;
};

/// Properties of a job that may be changed at any time.
struct JobChange {
  int priority = 0;
  std::vector<std::string> labels = {};
  bool keep = false;
};

/// Limits on all jobs of an owner together.
struct OwnerLimits {
  int max_active = 0;          ///< that may wait or run; 0: any number
  std::int64_t max_bytes = 0;  ///< that they may take already; 0: any
};

/// A job to be queued.
struct NewJob {
  std::string name;
  std::string spec_json = "{}";
  JobKind kind = JobKind::dataset;
  int priority = 0;
  std::vector<std::string> labels = {};
  std::string owner = {};
  /// A second submission of an owner with the same key is the first one's job; "" for none.
  std::string key = {};
  /// The hash of the request, which tells a repetition from a key that is used twice.
  std::string hash = {};
  OwnerLimits limits = {};  ///< of the owner, before this job
  int people = 0;           ///< ResolvedJob::people()
};

/// A job that was queued again.
struct Retried {
  std::optional<JobRow> row = {};  ///< nothing when someone else was faster
  std::string over_quota = {};     ///< why it was not queued: the owner has as much as they may
};

struct Added {
  JobRow row;
  bool is_new = true;           ///< else the job of an earlier submission with this key
  bool is_equal = true;         ///< false: and what was sent then was something else
  std::string over_quota = {};  ///< why nothing was queued: the owner has as much as they may
};

/// Jobs with this label are seen by all keys.
inline constexpr const char* kSharedLabel = "shared";

/// Which jobs to list.
struct JobFilter {
  JobKind kind = JobKind::dataset;
  std::vector<JobState> states = {};  ///< none: any
  std::string label = {};             ///< "": any
  std::string name_part = {};         ///< in upper or lower case; "": any
  bool oldest_first = false;          ///< else newest first
  std::string after = {};             ///< the id that the last page ended with; "": from the start
  int limit = 50;
  std::optional<std::string> visible_to = {};  ///< an owner: their own and shared ones only
};

/// Something that happened to a job. Numbers rise over all jobs and are never used twice.
struct EventRow {
  std::int64_t seq = 0;
  std::string job;
  std::int64_t at_ms = 0;  ///< Unix time
  std::string type;  ///< "submitted", to_string(JobEvent), "changed", "removed" or record_event()'s
  std::string data_json;
};

/// Safe to use from many threads.
class Store {
 public:
  /// Milliseconds of Unix time.
  using Clock = std::function<std::int64_t()>;

  /// Opens or creates the store in `folder`. Throws EnvironmentError when another process has it
  /// open, or when it cannot be read or was written by a newer throng.
  /// `steady` is that of ServiceClock.
  explicit Store(const std::filesystem::path& folder, Clock clock = {}, Clock steady = {});
  ~Store();
  Store(const Store&) = delete;
  Store& operator=(const Store&) = delete;

  /// Queues a job unless one of its key is there. Durable.
  Added add(const NewJob& job);

  std::optional<JobRow> get(const std::string& id) const;
  std::vector<JobRow> list(const JobFilter& filter) const;
  /// How many jobs of any kind are in each state.
  std::map<JobState, std::int64_t> count() const;
  /// Jobs that may be begun: those that are running, and of each owner the queued one that is next,
  /// the oldest of their highest priority.
  std::vector<JobRow> startable() const;

  /// Applies an event if the job is still in the state and attempt of `row`, and the state allows
  /// it; returns the new row. Nothing when someone else was faster. Durable.
  std::optional<JobRow> apply(const JobRow& row, JobEvent event,
                              const std::string& error_json = "");

  /// Applies JobEvent::retry within the limits of the job's owner. Durable.
  Retried retry(const JobRow& row, const OwnerLimits& limits);

  /// Returns the new row, nothing when there is none. Durable.
  std::optional<JobRow> change(const std::string& id, const JobChange& change);

  /// Remembers how much disk a job's files take.
  void set_bytes(const std::string& id, std::int64_t bytes);

  /// Jobs of any kind that have ended and need not be kept, those that ended first before others.
  std::vector<JobRow> ended(int limit) const;
  /// The size of all jobs' files.
  std::int64_t total_bytes() const;
  /// Forgets events of removed jobs that are older than this. Returns how many.
  int forget_events(std::int64_t before_ms);

  /// Remembers the progress of a running attempt; nothing happens when the job has moved on. Costs
  /// a disk sync: call it at most about once a second.
  void save_progress(const JobRow& row, const std::string& progress_json);

  /// Records that something happened to a running attempt, likewise.
  void record_event(const JobRow& row, const std::string& type, const std::string& data_json);

  /// At most `limit` events after number `after`, in their order: of one job, or of all ("").
  std::vector<EventRow> events(const std::string& job, std::int64_t after, int limit) const;
  /// The number of the newest event; 0 for none.
  std::int64_t last_event() const;

  /// The time by the store's clock.
  std::int64_t now_ms() const { return clock_(); }
  /// The time by which jobs are kept (jobs/queue/store/service_clock.h).
  std::int64_t service_ms() const;
  /// Saves that time for the next process. Call it every minute or so.
  void save_service_clock();

  /// Throws EnvironmentError if the store's files were removed or replaced: changes are refused.
  void check_files() const;

  /// Forgets a job and what happened to it. False when there is none. Durable.
  bool remove(const std::string& id);

 private:
  struct Connections;
  std::unique_ptr<Connections> connections_;
  Clock clock_;
};

}  // namespace throng::jobs
