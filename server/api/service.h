// The service without HTTP: composition of its parts.
#pragma once

#include <filesystem>
#include <memory>

#include "jobs/queue/confine/confined_task.h"
#include "jobs/queue/dataset/folder_lock.h"
#include "jobs/queue/store/store.h"
#include "jobs/queue/workers/executor.h"
#include "jobs/queue/workers/task_meters.h"
#include "server/catalog/calibrations.h"
#include "server/catalog/confined_checks.h"
#include "server/catalog/queue_state.h"
#include "server/catalog/service_folders.h"
#include "server/catalog/studies.h"
#include "server/catalog/uploads.h"
#include "server/jobs/datasets.h"
#include "server/jobs/disk_reserve.h"
#include "server/jobs/drain.h"
#include "server/jobs/housekeeping.h"
#include "server/jobs/job_queue.h"
#include "server/jobs/job_runner.h"
#include "server/jobs/publish_targets.h"
#include "server/jobs/report_maker.h"
#include "server/live/live_flights.h"

namespace throng::server {

/// Options of the parts.
struct ServiceOptions {
  std::filesystem::path data;           ///< data folder, used by one service at a time
  std::filesystem::path database = {};  ///< folder of the job store; "": `data`
  std::filesystem::path scenarios;      ///< folder of the shipped scenarios
  jobs::ConfinedTask confined;          ///< checks user input in confined child processes
  UploadLimits uploads = {};
  HousekeepingOptions housekeeping = {};
  int max_active_jobs = 16;       ///< max number of running jobs (server/jobs/job_runner.h)
  std::int64_t max_task_mib = 0;  ///< max memory of a task (ConfinedChecks); 0: unlimited
  PublishTargets publish_to = PublishTargets();  ///< addresses to which jobs may publish
  LiveLimits live = {};
  DrainOptions drain = {};
  std::shared_ptr<const jobs::TaskMeters> tasks =
      std::make_shared<jobs::TaskMeters>();  ///< those that the executor notes attempts in
  jobs::Store::Clock clock = {};             ///< default: the system clock
  jobs::Store::Clock steady = {};            ///< clock of jobs::ServiceClock
};

/// The parts are safe to use from many threads.
class Service {
 public:
  /// Opens the data folder, resumes running jobs and starts queued ones. The executor must outlive
  /// the service. The disk's reserve is free until reserve().started().
  Service(const ServiceOptions& options, jobs::Executor& executor);

  const ServiceFolders& folders() const { return folders_; }
  const ConfinedChecks& confined() const { return confined_; }
  JobQueue& queue() { return queue_; }
  const JobQueue& queue() const { return queue_; }
  Uploads& uploads() { return uploads_; }
  Calibrations& calibrations() { return calibrations_; }
  Studies& studies() { return studies_; }
  DiskReserve& reserve() { return reserve_; }
  Housekeeping& housekeeping() { return housekeeping_; }
  Datasets& datasets() { return datasets_; }
  ReportMaker& reports() { return reports_; }
  LiveFlights& live() { return live_; }
  Drain& drain() { return drain_; }
  const jobs::TaskMeters& tasks() const { return *tasks_; }
  const jobs::Executor& executor() const { return executor_; }

 private:
  const jobs::Executor& executor_;
  // Each member uses only members above it.
  ServiceFolders folders_;
  jobs::FolderLock lock_;  ///< of the jobs: the store's file can be removed while the service runs
  PublishTargets publish_to_;
  DiskReserve reserve_;
  jobs::Store store_;
  ConfinedChecks confined_;
  QueueState state_;
  Uploads uploads_;
  Calibrations calibrations_;
  Studies studies_;
  JobQueue queue_;
  Housekeeping housekeeping_;
  ReportMaker reports_;
  Datasets datasets_;
  LiveFlights live_;
  JobRunner runner_;
  std::shared_ptr<const jobs::TaskMeters> tasks_;
  Drain drain_;
};

}  // namespace throng::server
