// LRU cache of values that are expensive to create and requested by many clients.
#pragma once

#include <cstddef>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <string>

namespace throng::server {

/// Keeps the most recently requested values and all that are in use. Safe to use from many threads;
/// values are created one at a time.
template <typename Value>
class LruCache {
 public:
  explicit LruCache(std::size_t kept) : capacity_(kept) {}

  /// The value with this name; the result of `make` if there is none.
  template <typename Make>
  std::shared_ptr<const Value> get(const std::string& name, const Make& make) {
    const std::lock_guard lock(mutex_);
    std::shared_ptr<const Value> value = used_[name].lock();
    if (!value) {
      std::erase_if(used_, [](const auto& entry) { return entry.second.expired(); });
      value = std::make_shared<const Value>(make());
      used_[name] = value;
    }
    std::erase(kept_, value);
    kept_.push_back(value);
    if (kept_.size() > capacity_) kept_.pop_front();
    return value;
  }

 private:
  std::size_t capacity_;
  std::mutex mutex_;
  std::map<std::string, std::weak_ptr<const Value>> used_;
  std::deque<std::shared_ptr<const Value>> kept_;  ///< most recently used value last
};

}  // namespace throng::server
