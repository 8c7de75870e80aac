// Long pieces of work that know nothing of each other, several at a time.
#pragma once

#include <cstddef>
#include <functional>
#include <stop_token>

namespace throng {

/// Calls item(0) ... item(count - 1), each once and in this order of beginning, on `threads`
/// threads (0: one per core); within one there is a single thread (TBB's loops too). When one
/// throws, no more begin and the first exception is thrown on after the others have ended. Throws
/// Cancelled when `stop` was requested.
void run_items(std::size_t count, int threads, const std::stop_token& stop,
               const std::function<void(std::size_t)>& item);

}  // namespace throng
