#include "jobs/queue/slurm/slurm_refusals.h"

#include <algorithm>
#include <cmath>

#include "jobs/queue/slurm/slurm_state.h"

namespace throng::jobs {

std::size_t SlurmRefusals::max_tasks() const {
  return std::min(max_accepted_, shared_.max_tasks.load());
}

void SlurmRefusals::begin() {
  next_submission_ = steady_now() + steady_seconds(shared_.options.poll_s);
}

void SlurmRefusals::accept() {
  text_.clear();
  count_ = 0;
  max_accepted_ = std::min(kMaxArrayTasks, 2 * max_accepted_);
}

void SlurmRefusals::refuse(const SlurmAnswer& answer, std::size_t tasks) {
  const std::size_t half = std::max<std::size_t>(1, tasks / 2);
  text_ = answer.is_away ? "" : answer.text.substr(0, answer.text.find('\n'));
  if (is_array_too_large(answer.text) && tasks > 1) {
    shared_.max_tasks = std::min(shared_.max_tasks.load(), half);
    count_ = std::max(count_, 1);
    next_submission_ = {};
    return;
  }
  if (!answer.is_away) max_accepted_ = half;
  constexpr int kMaxDoublings = 6;
  const double rest_s = shared_.options.rest_s * std::pow(2.0, std::min(count_++, kMaxDoublings));
  next_submission_ = steady_now() + steady_seconds(rest_s);
}

}  // namespace throng::jobs
