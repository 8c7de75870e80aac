// End of the service when the running tasks have finished.
#pragma once

#include <chrono>
#include <functional>
#include <mutex>
#include <thread>

#include "jobs/queue/workers/executor.h"
#include "server/catalog/queue_state.h"

namespace throng::server {

struct DrainOptions {
  std::chrono::milliseconds limit = std::chrono::minutes(5);  ///< max wait for running tasks
  std::function<void()> on_end = [] {};                       ///< ends the service
};

/// Safe to use from many threads.
class Drain {
 public:
  /// References must outlive this object.
  Drain(QueueState& state, jobs::Executor& executor, DrainOptions options)
      : state_(state), executor_(executor), options_(std::move(options)) {}

  /// From now on no job and no task is started; DrainOptions::on_end is called when no task runs.
  /// Queued and running jobs stay so in the store. Further calls have no effect.
  void begin();
  bool has_begun() const { return state_.is_draining(); }

 private:
  QueueState& state_;
  jobs::Executor& executor_;
  DrainOptions options_;
  std::mutex mutex_;
  std::jthread thread_;  ///< last member: joined before the others end
};

}  // namespace throng::server
