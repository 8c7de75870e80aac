// Sessions of browsers: a key is entered once and becomes a cookie that scripts cannot read. They
// are kept in memory and end with the service; a revoked key's sessions end at once, because the
// key is looked up at each request.
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

  /// Begins a session with a key and returns its token. There may be 1000 at once; the one that was
  /// not used for the longest time ends for another.
  std::string open(std::string key);
  /// Key of the session; "" when there is no such session or it was unused for a week.
  std::string key_of(std::string_view token);
  void close(std::string_view token);

 private:
  struct Session {
    std::string key;
    SteadyTime used;
  };

  SteadyNow now_;
  std::mutex mutex_;
  std::map<std::string, Session> sessions_;  ///< by the hash of the token
};

}  // namespace throng::server
