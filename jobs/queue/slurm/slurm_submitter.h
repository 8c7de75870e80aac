// Submission of tasks as array jobs.
#pragma once

#include <cstddef>
#include <list>
#include <string>
#include <vector>

#include "jobs/queue/slurm/slurm_array.h"
#include "jobs/queue/slurm/slurm_call.h"
#include "jobs/queue/slurm/slurm_ends.h"
#include "jobs/queue/slurm/slurm_refusals.h"
#include "jobs/queue/slurm/slurm_tasks.h"

namespace throng::jobs {

/// Submits the tasks of one call; all arguments must outlive it.
class SlurmSubmitter {
 public:
  SlurmSubmitter(const SlurmCall& call, SlurmTasks& tasks, std::list<SlurmArray>& arrays,
                 SlurmEnds& ends)
      : call_(call), tasks_(tasks), arrays_(arrays), ends_(ends), refusals_(call.shared) {}

  /// Submits the tasks that need not rest: one array for all that need the same.
  void submit_ready();
  /// Takes sbatch's answer if it has come. Tasks that were refused wait again.
  void finish(SlurmArray& array);
  /// Finds the number of an array in the queue by its name: the server died between the submission
  /// and the note of its number. Tasks of an array that is not there wait again.
  void find_number(SlurmArray& array, const SlurmQueue& queue);
  /// Why Slurm has refused the last submission; "" if it has not.
  const std::string& refusal() const { return refusals_.text(); }

 private:
  void submit(const SlurmNeed& need, const std::vector<std::size_t>& tasks);
  void abandon(SlurmArray& array);

  const SlurmCall& call_;
  SlurmTasks& tasks_;
  std::list<SlurmArray>& arrays_;
  SlurmEnds& ends_;
  SlurmRefusals refusals_;
};

}  // namespace throng::jobs
