#include "server/access/sessions.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "base/files/hash.h"
#include "server/access/random_text.h"

namespace throng::server {

namespace {

constexpr std::size_t kMaxSessions = 10'000;
constexpr std::size_t kMaxSessionsOfKey = 20;
constexpr std::size_t kTokenLength = 32;
constexpr std::chrono::hours kMaxIdle(7 * 24);

}  // namespace

Sessions::Sessions(SteadyNow now) : now_(std::move(now)) {}

std::string Sessions::open(std::string key) {
  std::string token = random_text(kTokenLength);
  const std::lock_guard lock(mutex_);
  // A key that signs in again and again signs out nobody else.
  const auto of_key = std::count_if(sessions_.begin(), sessions_.end(),
                                    [&](const auto& entry) { return entry.second.key == key; });
  if (of_key >= static_cast<std::ptrdiff_t>(kMaxSessionsOfKey)) close_oldest(&key);
  if (sessions_.size() >= kMaxSessions) close_oldest(nullptr);
  sessions_[sha256_hex(token)] = {std::move(key), now_()};
  return token;
}

void Sessions::close_oldest(const std::string* key) {
  auto oldest = sessions_.end();
  for (auto entry = sessions_.begin(); entry != sessions_.end(); ++entry) {
    if (key != nullptr && entry->second.key != *key) continue;
    if (oldest == sessions_.end() || entry->second.used < oldest->second.used) oldest = entry;
  }
  if (oldest != sessions_.end()) sessions_.erase(oldest);
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
