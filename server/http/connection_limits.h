// Bounds in time of what a client's connection may take.
#pragma once

#include <chrono>

namespace throng::server {

struct ConnectionLimits {
  std::chrono::milliseconds head_time{5'000};  ///< from a head's first byte to its last
  std::chrono::milliseconds silence{10'000};   ///< in which nothing arrives
  std::chrono::milliseconds stalled{30'000};   ///< in which nothing can be sent
  std::chrono::milliseconds idle{2'000};       ///< between requests
  /// A body may be slower than this for so long.
  double body_bytes_per_s = 16'384;
  std::chrono::milliseconds body_timeout{10'000};
};

}  // namespace throng::server
