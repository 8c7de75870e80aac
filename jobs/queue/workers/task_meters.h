// Metrics of the attempts at tasks, on this machine and on a cluster.
#pragma once

#include <string>

#include "base/text/prometheus.h"
#include "jobs/queue/workers/executor.h"

namespace throng::jobs {

/// Safe to use from many threads.
class TaskMeters {
 public:
  /// Notes that an attempt at a task has ended. `outcome` is to_string(Outcome), or "lost" on a
  /// cluster.
  void note(const Task& task, const std::string& outcome, double seconds);
  /// In the text format of Prometheus; "" before the first attempt has ended.
  std::string text() const { return seconds_.text() + attempts_.text(); }

 private:
  PrometheusMeter seconds_{"throng_task_seconds",
                           "Duration of attempts at tasks that succeeded, by kind.",
                           {0.5, 1, 2, 5, 10, 30, 60, 300, 1800, 7200}};
  PrometheusMeter attempts_{"throng_task_attempts_total",
                            "Attempts at tasks that have ended, by kind and outcome."};
};

}  // namespace throng::jobs
