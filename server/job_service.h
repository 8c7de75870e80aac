// The queue at work: takes jobs in, runs one at a time in the background, answers for them. Knows
// nothing of HTTP.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <set>
#include <shared_mutex>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "base/error.h"
#include "jobs/queue/executor.h"
#include "jobs/queue/folder.h"
#include "jobs/queue/store.h"
#include "jobs/queue/supervisor.h"
#include "server/bell.h"
#include "server/calibrator.h"
#include "server/confined_checks.h"
#include "server/datasets.h"
#include "server/disk_watch.h"
#include "server/report_maker.h"
#include "server/retention.h"
#include "server/scenario_store.h"
#include "server/text_cache.h"

namespace throng::jobs {
class ResolvedJob;
}  // namespace throng::jobs

namespace throng::server {

struct JobServiceOptions {
  std::filesystem::path data;       ///< holds the store and a folder per job; one service at a time
  std::filesystem::path scenarios;  ///< those that come with throng
  jobs::ConfinedTask confined;      ///< checks of what users send
  /// Default: there are no calibrations.
  Calibrator calibrator = [](const auto&...) {
    throw EnvironmentError("no calibrations are made here");
  };
  /// Default: there are no reports.
  Reporter reporter = [](const auto&...) { throw EnvironmentError("no reports are made here"); };
  UploadLimits uploads = {};
  Retention retention = {};
  std::int64_t least_free_bytes = 512LL << 20;  ///< below this the queue rests
  DiskWatch::FreeBytes free_bytes = {};         ///< default: of the data folder's disk
  jobs::Store::Clock clock = {};                ///< default: the system's
};

/// A job to be queued.
struct Submission {
  std::string_view job_json;
  int priority = 0;
  std::vector<std::string> labels = {};
  std::string key = {};         ///< the same key again is the same submission; "" for none
  std::string owner = {};       ///< the id of the caller's key
  int most_active = 0;          ///< jobs that the owner may have waiting or running; 0: any number
  std::int64_t most_bytes = 0;  ///< that the owner's jobs may take already; 0: any
};

/// Whose submission it is, and what all of theirs may be.
struct Quota {
  std::string owner = {};       ///< the id of the caller's key
  int most_active = 0;          ///< that may wait or run; 0: any number
  std::int64_t most_bytes = 0;  ///< that all may take already; 0: any
};

/// Somebody has as many jobs as they may have. Answered with 429.
class QuotaError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What is asked for cannot happen in the state that the job is in. Answered with 409.
class ConflictError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A file that came with a calibration's request.
struct Upload {
  std::string name;
  std::string bytes;
};

/// Safe to use from many threads. Errors are InputError and EnvironmentError.
class JobService {
 public:
  /// Opens the data folder and goes on with what it finds there: jobs that were running are
  /// resumed, queued ones stay queued. The executor must outlive the service.
  JobService(JobServiceOptions options, jobs::Executor& executor);
  /// Ends the workers; the job they were at stays "running" in the store, to be resumed.
  ~JobService();
  JobService(const JobService&) = delete;
  JobService& operator=(const JobService&) = delete;

  /// Resolves a job in a confined child. Throws InputError.
  jobs::ResolvedJob checked(std::string_view job_json) const;

  /// Queues the job if it can be done; durable when it returns. Throws InputError.
  jobs::Added submit(const Submission& submission);

  /// Likewise with a bundle of scenarios of the job's own (zip, tar), of which the job names one as
  /// "bundle/NAME"; it is kept as long as there is a job that names it. The same bundle is kept
  /// once. Throws InputError and UploadsFull.
  jobs::Added submit_with_bundle(const Submission& submission, std::string_view bundle);
  /// The same, without queueing it.
  jobs::ResolvedJob checked_with_bundle(std::string_view job_json, std::string_view bundle);

  const ConfinedChecks& confined() const { return confined_; }

  /// Scenarios that users have sent; removed with remove_scenarios().
  ScenarioStore& uploads() { return scenarios_; }
  /// Removes an upload. False when there is none. Throws ConflictError while an active job uses it.
  bool remove_scenarios(const std::string& name);

  /// Queues a calibration (calibrate/request.h) of the files that came with it; durable when it
  /// returns. Counts among the owner's jobs. Throws InputError and QuotaError.
  jobs::JobRow submit_calibration(std::string_view request_json, const std::vector<Upload>& files,
                                  const Quota& quota = {});

  /// A job or calibration with its newest progress.
  std::optional<jobs::JobRow> get(const std::string& id) const;
  /// What `write` makes of a job, as it was made the last time if nothing has happened to any job
  /// since: many clients ask for the same. Nothing when there is none.
  std::shared_ptr<const std::string> text_of_job(
      const std::string& id, const std::function<std::string(const jobs::JobRow&)>& write) const;
  std::vector<jobs::JobRow> list(const jobs::JobFilter& filter) const;
  std::map<jobs::JobState, std::int64_t> count() const { return store_.count(); }

  /// Whatever the job's state; nothing when there is none.
  std::optional<jobs::JobRow> change(const std::string& id, const jobs::JobChange& change);

  /// Ends an active job and returns when nobody works on it any more; what it has published stays.
  /// Nothing when there is none. Throws ConflictError when it has ended.
  std::optional<jobs::JobRow> cancel(const std::string& id);

  /// Queues a job again that failed, at least in part, or was cancelled; what it has published is
  /// not done again.
  /// Nothing when there is none. Throws ConflictError in any other state.
  std::optional<jobs::JobRow> retry(const std::string& id);

  /// Events after number `after` of a job, or of all (""): at once if there are any, else as soon
  /// as there are, else none after `patience`.
  std::vector<jobs::EventRow> events(const std::string& job, std::int64_t after, int limit,
                                     std::chrono::milliseconds patience) const;

  /// Ends the job if it is active and removes it with all its files. False when there is none.
  bool remove(const std::string& id);

  /// The number of the newest event; 0 for none.
  std::int64_t last_event() const { return store_.last_event(); }

  /// One of at most `most` watchers of events, as long as it is held; null when there are as many.
  std::shared_ptr<void> begin_watch(int most);
  int watchers() const { return *watchers_; }

  /// Why the queue rests; "" when it does not.
  std::string paused() const;
  const Retention& retention() const { return options_.retention; }
  /// Removes what has been kept for long enough. Done by itself every minute.
  void remove_expired();

  const std::filesystem::path& data_folder() const { return options_.data; }
  /// Where all scenarios are found: shipped ones and uploads.
  const std::filesystem::path& scenarios() const { return scenarios_.folder(); }
  /// Where everything that belongs to a job lies (jobs/queue/folder.h).
  std::filesystem::path job_folder(const std::string& id) const { return folder_of(id).path(); }

  /// Where a job's dataset lies once it has succeeded.
  std::filesystem::path dataset_of(const std::string& id) const { return folder_of(id).dataset(); }

  Datasets& datasets() { return datasets_; }

  /// The report of a job that has a dataset (ReportMaker::report_of).
  std::optional<std::filesystem::path> report_of(const std::string& id,
                                                 std::chrono::milliseconds patience) {
    return reports_.report_of(job_folder(id), patience);
  }

  /// Where a calibration's results lie once it has succeeded.
  std::filesystem::path calibration_folder(const std::string& id) const;

  /// A message without the places of this machine's folders.
  std::string without_paths(std::string message) const;
  std::vector<Problem> without_paths(std::vector<Problem> problems) const;

 private:
  /// The job that is being worked on.
  struct Active {
    jobs::JobRow row;
    std::stop_source stop;
  };

  void work(const std::stop_token& stop);
  bool work_on_next(const std::stop_token& stop);
  void run(const jobs::JobRow& row, const std::stop_token& stop);
  void pause(const std::string& reason);
  void sweep(const std::stop_token& stop);
  std::optional<jobs::JobRow> apply(const jobs::JobRow& row, jobs::JobEvent event,
                                    const std::string& error_json = "");
  void end_work_on(const std::string& id);
  void tell();
  std::vector<jobs::RunFailure> make_dataset(const jobs::JobRow& row, const std::stop_token& stop);
  void make_calibration(const jobs::JobRow& row, const std::stop_token& stop);
  nlohmann::json camera_of(const std::string& calibration_id) const;
  std::filesystem::path place_of(const jobs::JobRow& row) const;
  void note_queued();
  void report(const jobs::JobRow& row, std::string progress_json);
  void save_progress(const jobs::JobRow& row);
  void note(const jobs::JobRow& row, const std::string& type, const std::string& data_json);
  /// Adds what only this process knows. Under mutex_.
  void complete(jobs::JobRow& row) const;
  jobs::JobFolder folder_of(const std::string& id) const;
  class PinnedBundle;
  void require_scenario(const jobs::JobSpec& job) const;
  std::vector<jobs::JobRow> jobs_that_name(const std::string& upload,
                                           std::vector<jobs::JobState> states) const;
  void drop_if_unused(const std::string& bundle);
  void drop_bundle_of(const jobs::JobRow& removed);
  void drop_unused_bundles();

  JobServiceOptions options_;
  jobs::Executor& executor_;
  jobs::Store store_;
  ConfinedChecks confined_;
  ScenarioStore scenarios_;
  /// Held together while a job that may name an upload is added, alone while uploads go.
  std::shared_mutex uploads_mutex_;
  std::multiset<std::string> pinned_;  ///< bundles that a request works with; guarded by it
  mutable std::mutex mutex_;
  std::condition_variable_any
      changed_;                   ///< something was queued, the active job has ended, a pause
  bool queued_ = true;            ///< there may be something to do; guarded by mutex_
  std::string paused_;            ///< guarded by mutex_
  std::optional<Active> active_;  ///< guarded by mutex_; its row carries the newest progress
  std::shared_ptr<std::atomic<int>> watchers_ = std::make_shared<std::atomic<int>>(0);
  mutable Bell bell_;                        ///< rings with every event
  std::atomic<std::uint64_t> revision_ = 0;  ///< changes with every event and with progress
  mutable TextCache texts_;
  DiskWatch disk_;
  ReportMaker reports_;
  Datasets datasets_;
  std::jthread worker_;  ///< these end before what they use
  std::jthread sweeper_;
};

}  // namespace throng::server
