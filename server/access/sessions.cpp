#include "server/access/sessions.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "base/files/hash.h"
#include "server/access/random_text.h"

namespace throng::server {

namespace {

constexpr std::size_t kMaxSessions = 1000;
constexpr std::size_t kTokenLength = 32;
constexpr std::chrono::hours kMaxIdle(7 * 24);

}  // namespace

Sessions::Sessions(SteadyNow now) : now_(std::move(now)) {}

std::string Sessions::open(std::string key) {
  std::string token = random_text(kTokenLength);
  const std::lock_guard lock(mutex_);
  if (sessions_.size() >= kMaxSessions) {
    sessions_.erase(std::min_element(
        sessions_.begin(), sessions_.end(),
        [](const auto& a, const auto& b) { return a.second.used < b.second.used; }));
  }
  sessions_[sha256_hex(token)] = {std::move(key), now_()};
  return token;
}

std::string Sessions::key_of(std::string_view token) {
  const std::lock_guard lock(mutex_);
  const auto found = sessions_.find(sha256_hex(token));
  if (found == sessions_.end()) return "";
  const SteadyTime now = now_();
  if (now - found->second.used > kMaxIdle) {
    sessions_.erase(found);
    return "";
  }
  found->second.used = now;
  return found->second.key;
}

void Sessions::close(std::string_view token) {
  const std::lock_guard lock(mutex_);
  sessions_.erase(sha256_hex(token));
}

}  // namespace throng::server
