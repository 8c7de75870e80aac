// The tasks of one call of SlurmArrays::run(), from their submission to their end.
#pragma once

#include <list>
#include <string>
#include <vector>

#include "jobs/queue/slurm/slurm_array.h"
#include "jobs/queue/slurm/slurm_call.h"
#include "jobs/queue/slurm/slurm_controller.h"
#include "jobs/queue/slurm/slurm_ends.h"
#include "jobs/queue/slurm/slurm_follower.h"
#include "jobs/queue/slurm/slurm_submitter.h"
#include "jobs/queue/slurm/slurm_tasks.h"
#include "jobs/queue/workers/executor.h"

namespace throng::jobs {

/// One call of SlurmArrays::run(). Use from one thread.
class SlurmBatch {
 public:
  explicit SlurmBatch(SlurmCall call);
  ~SlurmBatch();
  SlurmBatch(const SlurmBatch&) = delete;
  SlurmBatch& operator=(const SlurmBatch&) = delete;

  /// Takes up the tasks of an earlier process, submits the others, and returns when none runs any
  /// more.
  std::vector<TaskResult> run();

 private:
  void look(const SlurmQueue& queue);
  void say_why_nothing_runs(const SlurmQueue& queue);
  void drop_closed_arrays();
  std::vector<TaskResult> leave();

  const SlurmCall call_;
  SlurmController::Watch watch_;
  SlurmTasks tasks_;
  std::list<SlurmArray> arrays_;
  SlurmEnds ends_;
  SlurmFollower follower_;
  SlurmSubmitter submitter_;
  std::string pending_;  ///< reason_to_wait() of the last look
  std::string reason_;   ///< reason last passed to Share::on_wait
};

}  // namespace throng::jobs
