// Ends of attempts: the right to publish is revoked, Slurm cancels what still runs, the end is
// recorded, and the task is tried again or given up.
#pragma once

#include <chrono>
#include <cstddef>
#include <list>
#include <string>
#include <vector>

#include "jobs/queue/slurm/slurm_array.h"
#include "jobs/queue/slurm/slurm_call.h"
#include "jobs/queue/slurm/slurm_tasks.h"

namespace throng::jobs {

/// How late a wish to stop may be noticed.
inline constexpr std::chrono::milliseconds kSlurmTick(100);
/// How long a stop waits for workers to end. One that does not has lost its right to publish.
inline constexpr std::chrono::seconds kMaxSlurmWait(8);

/// Ends attempts in the arrays of one call; all arguments must outlive it.
class SlurmEnds {
 public:
  SlurmEnds(const SlurmCall& call, SlurmTasks& tasks, std::list<SlurmArray>& arrays)
      : call_(call), tasks_(tasks), arrays_(arrays) {}

  /// Ends an attempt that has published its output, on this node.
  void succeed(SlurmArray& array, SlurmEntry& entry, const std::string& node);
  /// Ends one that has failed, or was lost through no fault of its own.
  void end_attempt(SlurmArray& array, SlurmEntry& entry, const SlurmTask& state, TaskResult result,
                   bool is_blameless);
  /// Notes that an attempt at a task has failed, and ends others if the task is given up.
  void fail(std::size_t task, TaskResult result);
  /// Ends all tasks that the condition names as cancelled; none if it is null.
  void end_others(const SlurmTasks::Condition& condition);
  /// Records that an attempt runs no more.
  void note_end(const SlurmArray& array, const SlurmEntry& entry, const std::string& outcome,
                const std::string& message);
  /// Calls scancel once per array for all attempts that were ended since the last call.
  void cancel_ended();
  /// Waits for cancelled workers, so that nothing writes any more in a folder that is going to be
  /// removed.
  void wait_for_cancelled();

 private:
  void close(SlurmArray& array, SlurmEntry& entry, const std::string& outcome,
             const std::string& message);

  const SlurmCall& call_;
  SlurmTasks& tasks_;
  std::list<SlurmArray>& arrays_;
  std::vector<SlurmQueue::Key> cancelled_;  ///< attempts whose workers may still run
};

}  // namespace throng::jobs
