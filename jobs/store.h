// The durable queue: one SQLite file in the data folder, one server at a time. What a call has
// returned survives the death of the process and of the machine.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "jobs/state.h"

namespace throng::jobs {

/// What a queued job is asked to make.
enum class JobKind { dataset, calibration };

std::string_view name_of(JobKind kind);

/// One job as stored.
struct JobRow {
  std::string id;
  JobKind kind = JobKind::dataset;
  std::string name;
  JobState state = JobState::queued;
  int attempt = 0;              ///< how often a supervisor took it up
  std::string spec_json;        ///< the job with all defaults; a calibration's request
  std::string progress_json;    ///< the last that was saved; "" for none
  std::string error_json;       ///< why it failed; "" for none
  std::int64_t created_ms = 0;  ///< Unix time
  std::int64_t started_ms = 0;  ///< 0: not yet
  std::int64_t ended_ms = 0;    ///< 0: not yet
};

/// Safe to use from many threads.
class Store {
 public:
  /// Milliseconds of Unix time.
  using Clock = std::function<std::int64_t()>;

  /// Opens or creates the store in `folder`. Throws EnvironmentError when another process has it
  /// open, or when it cannot be read or was written by a newer throng.
  explicit Store(const std::filesystem::path& folder, Clock clock = {});
  ~Store();
  Store(const Store&) = delete;
  Store& operator=(const Store&) = delete;

  /// Queues a job and returns it. Durable.
  JobRow add(const std::string& name, const std::string& spec_json,
             JobKind kind = JobKind::dataset);

  std::optional<JobRow> get(const std::string& id) const;
  /// At most `limit` jobs of a kind, newest first, older than the job `after` (if not empty).
  std::vector<JobRow> list(int limit, const std::string& after = "",
                           JobKind kind = JobKind::dataset) const;
  /// The job to work on next: one that was running when the last server ended, else the oldest that
  /// is queued.
  std::optional<JobRow> next() const;

  /// Applies an event if the job is still in the state and attempt of `row`, and the state allows
  /// it; returns the new row. Nothing when someone else was faster. Durable.
  std::optional<JobRow> apply(const JobRow& row, JobEvent event,
                              const std::string& error_json = "");

  /// Remembers the progress of a running attempt; nothing happens when the job has moved on. Costs
  /// a disk sync: call it at most about once a second.
  void save_progress(const JobRow& row, const std::string& progress_json);

  /// Forgets a job. False when there is none. Durable.
  bool remove(const std::string& id);

 private:
  struct Connections;
  std::unique_ptr<Connections> connections_;
  Clock clock_;
};

}  // namespace throng::jobs
