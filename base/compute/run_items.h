// Parallel execution of long, independent tasks.
#pragma once

#include <cstddef>
#include <functional>
#include <stop_token>

namespace throng {

/// Calls item(0) ... item(count - 1), each once and started in this order, on `threads` threads (0:
/// one per core). Loops of TBB inside an item run on its thread only. After an exception, no more
/// items start; the first exception is rethrown when the running ones have ended. Throws Cancelled
/// if `stop` was requested.
void run_items(std::size_t count, int threads, const std::stop_token& stop,
               const std::function<void(std::size_t)>& item);

}  // namespace throng
