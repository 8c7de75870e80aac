// The queue at work: takes jobs in, runs one at a time in the background, answers for them. Knows
// nothing of HTTP.
#pragma once

#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "jobs/executor.h"
#include "jobs/folder.h"
#include "jobs/store.h"
#include "jobs/supervisor.h"
#include "server/calibrator.h"

namespace throng::server {

struct JobServiceOptions {
  std::filesystem::path data;       ///< holds the store and a folder per job; one service at a time
  std::filesystem::path scenarios;  ///< the scenarios that jobs may name
  Calibrator calibrator = calibrator_in_process();
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

  /// Queues the job if it can be done; durable when it returns. Throws InputError.
  jobs::JobRow submit(std::string_view job_json);

  /// Queues a calibration (calibrate/request.h) of the files that came with it; durable when it
  /// returns. Throws InputError.
  jobs::JobRow submit_calibration(std::string_view request_json, const std::vector<Upload>& files);

  /// A job or calibration with its newest progress.
  std::optional<jobs::JobRow> get(const std::string& id) const;
  /// Newest first, older than `after` (if not empty).
  std::vector<jobs::JobRow> list(int limit, const std::string& after,
                                 jobs::JobKind kind = jobs::JobKind::dataset) const;

  /// Ends the job if it is active and removes it with all its files. False when there is none.
  bool remove(const std::string& id);

  /// Where a job's dataset lies once it has succeeded.
  std::filesystem::path dataset_of(const std::string& id) const { return folder_of(id).dataset(); }

  /// Where a calibration's results lie once it has succeeded.
  std::filesystem::path calibration_folder(const std::string& id) const;

  /// A message without the places of this machine's folders.
  std::string without_paths(std::string message) const;

 private:
  /// The job that is being worked on.
  struct Active {
    jobs::JobRow row;
    std::stop_source stop;
  };

  void work(const std::stop_token& stop);
  bool work_on_next(const std::stop_token& stop);
  void run(const jobs::JobRow& row, const std::stop_token& stop);
  void make_dataset(const jobs::JobRow& row, const std::stop_token& stop);
  void make_calibration(const jobs::JobRow& row, const std::stop_token& stop);
  nlohmann::json camera_of(const std::string& calibration_id) const;
  std::filesystem::path place_of(const jobs::JobRow& row) const;
  void note_queued();
  void report(const jobs::JobRow& row, std::string progress_json);
  void save_progress(const jobs::JobRow& row);
  jobs::JobFolder folder_of(const std::string& id) const;

  JobServiceOptions options_;
  jobs::Executor& executor_;
  jobs::Store store_;
  mutable std::mutex mutex_;
  std::condition_variable_any changed_;  ///< something was queued, or the active job has ended
  bool queued_ = true;                   ///< there may be something to do; guarded by mutex_
  std::optional<Active> active_;         ///< guarded by mutex_; its row carries the newest progress
  std::jthread worker_;                  ///< last: ends before what it uses
};

}  // namespace throng::server
