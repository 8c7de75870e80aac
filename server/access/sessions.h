// Sessions of browsers: a user enters a key once, and the browser keeps a session cookie that
// scripts cannot read. Sessions are kept in memory and end with the service. Sessions of a revoked
// key end at once, because the key is checked at each request.
#pragma once

#include <map>
#include <mutex>
#include <string>
#include <string_view>

#include "base/compute/steady_time.h"

namespace throng::server {

/// Safe to use from many threads.
class Sessions {
 public:
  explicit Sessions(SteadyNow now = &steady_now);

  /// Opens a session for a key and returns its token. A key has at most 20 sessions, and all keys
  /// together 10 000: a further one replaces the least recently used one, of the same key or of
  /// all.
  std::string open(std::string key);
  /// The key of a session; "" if there is no such session or it was not used for a week.
  std::string key_of(std::string_view token);
  void close(std::string_view token);

 private:
  /// Closes the least recently used session of a key, or of all keys.
  void close_oldest(const std::string* key);

  struct Session {
    std::string key;
    SteadyTime used;
  };

  SteadyNow now_;
  std::mutex mutex_;
  std::map<std::string, Session> sessions_;  ///< by the hash of the token
};

}  // namespace throng::server
