// Limits what one sender may hold at once, so that others have the rest.
#pragma once

#include <chrono>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "base/compute/steady_time.h"

namespace throng::server {

/// Number of streams or requests that are held at once: of all senders, and of each key.
/// Senders without a key (none are required) have only the limit of all. Safe to use from many
/// threads.
class KeyLimit {
 public:
  explicit KeyLimit(int max_of_key, int max_all = std::numeric_limits<int>::max())
      : max_of_key_(max_of_key), max_all_(max_all) {}

  /// Holds one more until the result is destroyed; null if a limit is reached.
  std::shared_ptr<void> hold(const std::string& key);
  /// Number that is held.
  int held() const;

 private:
  struct Counts {
    std::mutex mutex;
    int all = 0;
    std::map<std::string, int> of_key;
  };

  const int max_of_key_;
  const int max_all_;
  std::shared_ptr<Counts> counts_ = std::make_shared<Counts>();  ///< outlives this object
};

/// Number of requests of each key per time: `burst` at once and one more each `interval`. Senders
/// without a key have no limit. Safe to use from many threads.
class KeyRate {
 public:
  KeyRate(int burst, std::chrono::milliseconds interval, SteadyNow now = &steady_now);

  /// Whether the key may send one more now.
  bool take(const std::string& key);

 private:
  const int burst_;
  const std::chrono::milliseconds interval_;
  SteadyNow now_;
  std::mutex mutex_;
  std::map<std::string, SteadyTime> free_from_;  ///< when all of a key's requests are free again
};

}  // namespace throng::server
