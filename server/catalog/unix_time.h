// The system clock.
#pragma once

#include <chrono>
#include <cstdint>

namespace throng::server {

/// The present Unix time in milliseconds.
inline std::int64_t unix_ms_now() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::milliseconds>(now).count();
}

}  // namespace throng::server
