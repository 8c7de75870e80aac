// Time limits of a client's connection.
#pragma once

#include <chrono>

namespace throng::server {

struct ConnectionLimits {
  std::chrono::milliseconds head_time{5'000};  ///< from a head's first byte to its last
  std::chrono::milliseconds silence{10'000};   ///< max time without received bytes
  std::chrono::milliseconds stalled{30'000};   ///< max time in which no bytes can be sent
  std::chrono::milliseconds idle{2'000};       ///< max time between requests
  /// Max time in which a client that still sends may read its last answer.
  std::chrono::milliseconds linger{2'000};
  double body_bytes_per_s = 16'384;  ///< min mean rate of a body after body_timeout
  std::chrono::milliseconds body_timeout{10'000};
};

}  // namespace throng::server
