// Refusals of submissions, and when and how much to submit after them.
#pragma once

#include <cstddef>
#include <string>

#include "base/compute/steady_time.h"
#include "jobs/queue/slurm/slurm_call.h"

namespace throng::jobs {

/// A limit on arrays, or on the tasks of a user, leaves room for smaller ones: the size of arrays
/// is halved with each refusal and doubled when one is accepted.
class SlurmRefusals {
 public:
  explicit SlurmRefusals(SlurmShared& shared) : shared_(shared) {}

  /// Whether it is time for another submission.
  bool may_submit() const { return steady_now() >= next_submission_; }
  /// Max tasks of the next array.
  std::size_t max_tasks() const;
  /// Notes a submission: tasks that end one by one are submitted together.
  void begin();
  void accept();
  /// Notes that an array of so many tasks was not accepted.
  void refuse(const SlurmAnswer& answer, std::size_t tasks);
  /// Number of consecutive refusals.
  int count() const { return count_; }
  /// Answer to the last submission; "" if it was accepted, or there was none.
  const std::string& text() const { return text_; }

 private:
  SlurmShared& shared_;
  std::string text_;
  int count_ = 0;
  std::size_t max_accepted_ = kMaxArrayTasks;
  SteadyTime next_submission_ = {};
};

}  // namespace throng::jobs
