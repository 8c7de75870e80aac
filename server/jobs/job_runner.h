// Runs the queued jobs: several at once, each supervised by a thread of its own. The executor
// decides how they share the workers (jobs/queue/workers/admission.h).
#pragma once

#include <atomic>
#include <functional>
#include <list>
#include <map>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "jobs/queue/store/store.h"
#include "jobs/queue/supervisor.h"
#include "jobs/queue/workers/executor.h"
#include "server/catalog/queue_state.h"
#include "server/catalog/service_folders.h"
#include "server/catalog/uploads.h"
#include "server/jobs/disk_watch.h"
#include "server/jobs/publish_targets.h"

namespace throng::server {

/// Runs jobs in threads from construction to destruction.
class JobRunner {
 public:
  /// Returns the reason why the disk has no free space; "" if it has.
  using LookAtDisk = std::function<std::string()>;

  /// Resumes the jobs that are running in the store. With `max_active` active jobs or more, starts
  /// a further one only for an owner without active jobs, or with a priority above all active ones.
  /// All references must outlive this object.
  JobRunner(const ServiceFolders& folders, jobs::Store& store, QueueState& state,
            const Uploads& uploads, jobs::Executor& executor, LookAtDisk look_at_disk,
            int max_active, const PublishTargets& publish_to);
  /// Ends the workers; active jobs stay "running" in the store and are resumed at the next start.
  ~JobRunner() = default;
  JobRunner(const JobRunner&) = delete;
  JobRunner& operator=(const JobRunner&) = delete;

 private:
  /// A thread that supervises a job.
  struct Supervisor {
    std::stop_source stop;
    std::atomic<bool> has_ended = false;
    std::jthread thread;
  };

  void dispatch(const std::stop_token& stop);
  bool begin_next();
  std::optional<jobs::JobRow> next_job() const;
  void join_ended();
  void work_on(const jobs::JobRow& row, const std::stop_token& stop);
  void run(const jobs::JobRow& row, const std::stop_token& stop);
  std::vector<jobs::RunFailure> make_dataset(const jobs::JobRow& row, const std::stop_token& stop);
  void make_calibration(const jobs::JobRow& row, const std::stop_token& stop);
  void make_study(const jobs::JobRow& row, const std::stop_token& stop);
  void require_target(const jobs::JobSpec& job, const jobs::JobFolder& folder,
                      const std::stop_token& stop) const;
  jobs::Share share_of(const jobs::JobRow& row) const;
  void fail_if_too_large(const jobs::JobRow& row);
  void save_progress(const jobs::JobRow& row);
  void save_bytes(const jobs::JobRow& row);

  const ServiceFolders& folders_;
  jobs::Store& store_;
  QueueState& state_;
  const Uploads& uploads_;
  jobs::Executor& executor_;
  LookAtDisk look_at_disk_;
  int max_active_;
  const PublishTargets& publish_to_;
  std::mutex stops_mutex_;
  std::map<std::string, int> stops_by_full_disk_;  ///< by job; guarded by stops_mutex_
  std::list<Supervisor> supervisors_;              ///< used by the dispatching thread only
  std::jthread thread_;                            ///< last member: joined before the others end
};

}  // namespace throng::server
