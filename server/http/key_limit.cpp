#include "server/http/key_limit.h"

#include <utility>

namespace throng::server {

std::shared_ptr<void> KeyLimit::hold(const std::string& key) {
  const std::lock_guard lock(counts_->mutex);
  if (counts_->all >= max_all_) return nullptr;
  int& of_key = counts_->of_key[key];
  if (!key.empty() && of_key >= max_of_key_) return nullptr;
  const auto release = [counts = counts_, key](void*) {
    const std::lock_guard lock_again(counts->mutex);
    --counts->all;
    if (--counts->of_key[key] == 0) counts->of_key.erase(key);
  };
  std::shared_ptr<void> held(counts_.get(), release);
  ++counts_->all;
  ++of_key;
  return held;
}

KeyRate::KeyRate(int burst, std::chrono::milliseconds interval, SteadyNow now)
    : burst_(burst), interval_(interval), now_(std::move(now)) {}

bool KeyRate::take(const std::string& key) {
  if (key.empty()) return true;
  const SteadyTime now = now_();
  const std::lock_guard lock(mutex_);
  std::erase_if(free_from_, [&](const auto& entry) { return entry.second <= now; });
  SteadyTime& free_from = free_from_.try_emplace(key, now).first->second;
  if (free_from - now > (burst_ - 1) * interval_) return false;
  free_from += interval_;
  return true;
}

int KeyLimit::held() const {
  const std::lock_guard lock(counts_->mutex);
  return counts_->all;
}

}  // namespace throng::server
