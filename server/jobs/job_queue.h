// Operations of clients on jobs, independent of HTTP: submit, list, cancel, retry, watch events.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "jobs/queue/store/store.h"
#include "server/catalog/calibrations.h"
#include "server/catalog/confined_checks.h"
#include "server/catalog/queue_state.h"
#include "server/catalog/service_errors.h"
#include "server/catalog/service_folders.h"
#include "server/catalog/text_cache.h"
#include "server/catalog/uploads.h"
#include "server/http/key_limit.h"
#include "server/jobs/publish_targets.h"
#include "spec/job/resolved_job.h"

namespace throng::server {

/// Each watcher holds a thread of the server.
inline constexpr int kMaxWatchers = 192;
inline constexpr int kMaxWatchersOfKey = 48;

/// A job to be queued.
struct Submission {
  nlohmann::json job;  ///< as it was sent
  int priority = 0;
  std::vector<std::string> labels = {};
  std::string key = {};        ///< idempotency key (jobs::NewJob::key); "" for none
  std::string owner = {};      ///< id of the caller's key
  Viewer viewer = {};          ///< whose calibrations it may use
  int max_active = 0;          ///< as jobs::OwnerLimits::max_active
  std::int64_t max_bytes = 0;  ///< as jobs::OwnerLimits::max_bytes
};

/// Safe to use from many threads. All members throw EnvironmentError.
class JobQueue {
 public:
  /// All arguments must outlive this object.
  JobQueue(const ServiceFolders& folders, jobs::Store& store, QueueState& state, Uploads& uploads,
           const Calibrations& calibrations, const ConfinedChecks& confined,
           const PublishTargets& publish_to);

  /// Checks and resolves a job without queuing it. It may use the cameras of calibrations that the
  /// viewer sees. Throws InputError.
  jobs::ResolvedJob resolve(nlohmann::json job, const Viewer& viewer) const;

  /// Checks a job and estimates its cost (ConfinedChecks::dry_run()) without queuing it. Throws
  /// InputError.
  nlohmann::json dry_run(nlohmann::json job, const Viewer& viewer = {}) const;
  /// As dry_run(), with a bundle as in submit_with_bundle().
  nlohmann::json dry_run_with_bundle(nlohmann::json job, std::string_view bundle,
                                     const Viewer& viewer = {});

  /// Checks and queues a job; durable when this returns. Throws InputError and QuotaError.
  jobs::Added submit(const Submission& submission);
  /// As submit(), with a bundle of scenarios (zip, tar), one of which the job names as
  /// "bundle/NAME". The bundle is kept as long as a job names it; equal bundles are stored once.
  /// Throws InputError, QuotaError and UploadsFull.
  jobs::Added submit_with_bundle(const Submission& submission, std::string_view bundle);

  /// A job of any kind with its newest progress; std::nullopt if there is none.
  std::optional<jobs::JobRow> get(const std::string& id) const;
  /// The text that `write` returns for a job; null if there is no such job. Cached until any job
  /// changes, because many clients request the same text.
  std::shared_ptr<const std::string> text_of_job(
      const std::string& id, const std::function<std::string(const jobs::JobRow&)>& write) const;
  std::vector<jobs::JobRow> list(const jobs::JobFilter& filter) const;
  std::map<jobs::JobState, std::int64_t> count() const { return store_.count(); }
  std::vector<jobs::OwnerCount> count_by_owner() const { return store_.count_by_owner(); }
  /// QueueState::ended_jobs()
  std::string ended_jobs() const { return state_.ended_jobs(); }
  /// Disk usage of all jobs.
  std::int64_t total_bytes() const { return store_.total_bytes(); }
  /// The reason why the queue is paused; "" if it is not.
  std::string paused() const { return state_.paused(); }
  /// Throws EnvironmentError if the store's files were removed or replaced (Store::check_files()).
  void check_store() const { store_.check_files(); }

  /// Disk usage of an owner's jobs (Store::bytes_of()).
  std::int64_t bytes_of(const std::string& owner) const { return store_.bytes_of(owner); }

  /// Changes the properties of a job in any state; std::nullopt if there is none.
  std::optional<jobs::JobRow> change(const std::string& id, const jobs::JobChange& change);
  /// Cancels an active job and blocks until its work has stopped; published output is kept. Returns
  /// std::nullopt if there is no such job. Throws ConflictError if it has ended.
  std::optional<jobs::JobRow> cancel(const std::string& id);
  /// Cancels all active jobs, calibrations and studies of these owners, without waiting for their
  /// work to stop. Returns their number.
  int cancel_all_of(const std::set<std::string>& owners);
  /// Queues a partial, failed or cancelled job again; published output is kept. Returns
  /// std::nullopt if there is no such job. Throws ConflictError in any other state, and QuotaError
  /// if the owner has reached one of `limits`.
  std::optional<jobs::JobRow> retry(const std::string& id, const jobs::OwnerLimits& limits = {});

  /// At most `limit` events with numbers above `after`, of one job or of all (""). Waits up to
  /// `timeout` for the first one.
  std::vector<jobs::EventRow> events(const std::string& job, std::int64_t after, int limit,
                                     std::chrono::milliseconds timeout) const;
  /// Ends all waits of events(), now and later: the service is about to end.
  void end_waits() { state_.event_counter().close(); }
  /// The number of the newest event; 0 for none.
  std::int64_t last_event() const { return store_.last_event(); }
  /// Registers a watcher of events, a stream or a request that waits for some, for the lifetime of
  /// the result; null if all keys together, or this key, have as many as they may.
  std::shared_ptr<void> begin_watch(const std::string& key) { return watchers_.hold(key); }
  int watchers() const { return watchers_.held(); }

 private:
  /// Replaces calibrations that the job names by their cameras.
  void put_cameras(nlohmann::json& job, const Viewer& viewer) const;
  void require_scenario(const jobs::JobSpec& job) const;
  /// Throws InputError for a job that cannot fit on an empty disk of the data folder.
  void require_disk(std::int64_t planned_bytes) const;

  const ServiceFolders& folders_;
  jobs::Store& store_;
  QueueState& state_;
  Uploads& uploads_;
  const Calibrations& calibrations_;
  const ConfinedChecks& confined_;
  const PublishTargets& publish_to_;
  KeyLimit watchers_{kMaxWatchersOfKey, kMaxWatchers};
  mutable TextCache texts_;
};

}  // namespace throng::server
