// Attempts that run, as Slurm's queue, its accounting and the workers' messages show them.
#pragma once

#include <list>
#include <optional>

#include "base/compute/steady_time.h"
#include "jobs/queue/slurm/slurm_array.h"
#include "jobs/queue/slurm/slurm_call.h"
#include "jobs/queue/slurm/slurm_ends.h"

namespace throng::jobs {

/// Follows the attempts of one call until they end; all arguments must outlive it.
class SlurmFollower {
 public:
  SlurmFollower(const SlurmCall& call, SlurmEnds& ends) : call_(call), ends_(ends) {}

  /// Looks at all open attempts, reads messages that are due, and ends attempts that have ended,
  /// were lost or take too long.
  void look(std::list<SlurmArray>& arrays, const SlurmQueue& queue);

 private:
  void look_at(SlurmArray& array, const SlurmQueue& queue);
  void look_at(SlurmArray& array, SlurmEntry& entry, const SlurmTask& state);
  void look_for_absent(SlurmArray& array, SlurmEntry& entry, const SlurmQueue& queue);
  void take_accounting(SlurmArray& array, const SlurmQueue& queue);
  void take_account(SlurmArray& array, SlurmEntry& entry, const std::optional<SlurmTask>& account);
  void begin_again(SlurmArray& array, SlurmEntry& entry, const SlurmTask& state);
  void follow(SlurmEntry& entry, const SlurmTask& state);
  void read_messages(SlurmEntry& entry);
  bool take_end(SlurmArray& array, SlurmEntry& entry, const SlurmTask& state);

  const SlurmCall& call_;
  SlurmEnds& ends_;
  SteadyTime next_messages_ = {};
  bool are_messages_due_ = false;  ///< in this look
};

}  // namespace throng::jobs
