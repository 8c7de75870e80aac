#include "server/jobs/drain.h"

#include <spdlog/spdlog.h>

#include <stop_token>

namespace throng::server {

void Drain::begin() {
  const std::lock_guard lock(mutex_);
  if (thread_.joinable()) return;
  spdlog::info("draining: the service ends when no task runs, in {} s at the latest",
               std::chrono::duration_cast<std::chrono::seconds>(options_.limit).count());
  state_.drain();
  thread_ = std::jthread([this](const std::stop_token& stop) {
    executor_.drain(options_.limit, stop);
    if (!stop.stop_requested()) options_.on_end();
  });
}

}  // namespace throng::server
