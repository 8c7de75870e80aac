// Jobs as clients see them: submitted, listed, cancelled, tried again, and their events. Knows
// nothing of HTTP.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
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
#include "server/jobs/publish_targets.h"
#include "spec/job/resolved_job.h"

namespace throng::server {

/// A job to be queued.
struct Submission {
  std::string_view job_json;
  int priority = 0;
  std::vector<std::string> labels = {};
  std::string key = {};        ///< the same key again is the same submission; "" for none
  std::string owner = {};      ///< the id of the caller's key
  int max_active = 0;          ///< jobs that the owner may have waiting or running; 0: any number
  std::int64_t max_bytes = 0;  ///< that the owner's jobs may take already; 0: any
};

/// Safe to use from many threads. Errors are InputError and EnvironmentError.
class JobQueue {
 public:
  /// All must outlive it.
  JobQueue(const ServiceFolders& folders, jobs::Store& store, QueueState& state, Uploads& uploads,
           const Calibrations& calibrations, const ConfinedChecks& confined,
           const PublishTargets& publish_to);

  /// The job, checked and completed; queues nothing. Throws InputError.
  jobs::ResolvedJob resolve(std::string_view job_json) const;

  /// Checks and estimates of a job before it runs (ConfinedChecks::dry_run()); queues nothing.
  /// Throws InputError.
  nlohmann::json dry_run(std::string_view job_json) const;
  /// Likewise with a bundle, as submit_with_bundle().
  nlohmann::json dry_run_with_bundle(std::string_view job_json, std::string_view bundle);

  /// Queues the job if it can be done; durable when it returns. Throws InputError and QuotaError.
  jobs::Added submit(const Submission& submission);
  /// Likewise with a bundle of scenarios of the job's own (zip, tar), of which the job names one as
  /// "bundle/NAME"; it is kept as long as there is a job that names it. The same bundle is kept
  /// once. Throws InputError and UploadsFull.
  jobs::Added submit_with_bundle(const Submission& submission, std::string_view bundle);

  /// A job or calibration with its newest progress.
  std::optional<jobs::JobRow> get(const std::string& id) const;
  /// Text that `write` makes of a job; cached until something happens to any job, since many
  /// clients request the same. Nothing when there is none.
  std::shared_ptr<const std::string> text_of_job(
      const std::string& id, const std::function<std::string(const jobs::JobRow&)>& write) const;
  std::vector<jobs::JobRow> list(const jobs::JobFilter& filter) const;
  std::map<jobs::JobState, std::int64_t> count() const { return store_.count(); }
  /// Why the queue is paused; "" when it is not.
  std::string paused() const { return state_.paused(); }
  /// Throws EnvironmentError if the store takes no changes (jobs/queue/store/store.h).
  void check_store() const { store_.check_files(); }

  /// In any state of the job; nothing when there is none.
  std::optional<jobs::JobRow> change(const std::string& id, const jobs::JobChange& change);
  /// Ends an active job and returns when nobody works on it any more; what it has published stays.
  /// Nothing when there is none. Throws ConflictError when it has ended.
  std::optional<jobs::JobRow> cancel(const std::string& id);
  /// Queues a job again that failed, at least in part, or was cancelled; what it has published is
  /// not done again. Nothing when there is none. Throws ConflictError in any other state, and
  /// QuotaError when its owner has as much as `limits` allow.
  std::optional<jobs::JobRow> retry(const std::string& id, const jobs::OwnerLimits& limits = {});

  /// Events after number `after` of a job, or of all (""): at once if there are any, else as soon
  /// as there are, else none after `timeout`.
  std::vector<jobs::EventRow> events(const std::string& job, std::int64_t after, int limit,
                                     std::chrono::milliseconds timeout) const;
  /// The number of the newest event; 0 for none.
  std::int64_t last_event() const { return store_.last_event(); }
  /// One of at most `max` watchers of events, as long as it is held; null when there are as many.
  std::shared_ptr<void> begin_watch(int max);
  int watchers() const { return *watchers_; }

 private:
  /// The text with the cameras of the calibrations that it names.
  std::string with_cameras(std::string_view job_json) const;
  void require_scenario(const jobs::JobSpec& job) const;

  const ServiceFolders& folders_;
  jobs::Store& store_;
  QueueState& state_;
  Uploads& uploads_;
  const Calibrations& calibrations_;
  const ConfinedChecks& confined_;
  const PublishTargets& publish_to_;
  std::shared_ptr<std::atomic<int>> watchers_ = std::make_shared<std::atomic<int>>(0);
  mutable TextCache texts_;
};

}  // namespace throng::server
