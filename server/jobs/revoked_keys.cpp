#include "server/jobs/revoked_keys.h"

#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <set>
#include <stop_token>

#include "base/error.h"

namespace throng::server {

RevokedKeys::RevokedKeys(const Keys& keys, JobQueue& queue, LiveFlights& live)
    : keys_(keys), queue_(queue), live_(live), thread_([this](const std::stop_token& stop) {
        constexpr std::chrono::seconds kPause(2);
        std::unique_lock lock(mutex_);
        while (!stop.stop_requested()) {
          try {
            end_work();
          } catch (const EnvironmentError& error) {
            spdlog::debug("revoked keys: {}", error.what());  // requests fail, and say why
          }
          never_.wait_for(lock, stop, kPause, [] { return false; });
        }
      }) {}

RevokedKeys::Ended RevokedKeys::end_work() const {
  std::set<std::string> revoked;
  for (const KeyRow& key : keys_.list()) {
    if (key.revoked_ms != 0) revoked.insert(key.id);
  }
  if (revoked.empty()) return {};
  return {queue_.cancel_all_of(revoked), live_.remove_all_of(revoked)};
}

}  // namespace throng::server
