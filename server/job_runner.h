// The queue at work: one job at a time, in a thread of its own.
#pragma once

#include <functional>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "jobs/queue/executor.h"
#include "jobs/queue/store.h"
#include "jobs/queue/supervisor.h"
#include "server/calibrator.h"
#include "server/queue_state.h"
#include "server/service_folders.h"

namespace throng::server {

class JobRunner {
 public:
  /// Checks the disk: the reason why it has no free space, "" when it has.
  using LookAtDisk = std::function<std::string()>;

  /// Goes on with what it finds in the store: a job that was running is resumed. All must outlive
  /// it.
  JobRunner(const ServiceFolders& folders, jobs::Store& store, QueueState& state,
            jobs::Executor& executor, Calibrator calibrator, LookAtDisk look_at_disk);
  /// Ends the workers; the job they were at stays "running" in the store, to be resumed.
  ~JobRunner() = default;
  JobRunner(const JobRunner&) = delete;
  JobRunner& operator=(const JobRunner&) = delete;

 private:
  void work(const std::stop_token& stop);
  bool work_on_next(const std::stop_token& stop);
  void run(const jobs::JobRow& row, const std::stop_token& stop);
  std::vector<jobs::RunFailure> make_dataset(const jobs::JobRow& row, const std::stop_token& stop);
  void make_calibration(const jobs::JobRow& row, const std::stop_token& stop);
  void save_progress(const jobs::JobRow& row);

  const ServiceFolders& folders_;
  jobs::Store& store_;
  QueueState& state_;
  jobs::Executor& executor_;
  Calibrator calibrator_;
  LookAtDisk look_at_disk_;
  std::jthread thread_;  ///< last: ends before what it uses
};

}  // namespace throng::server
