// Loops over independent items on TBB's threads.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cstddef>

#if defined(__SANITIZE_THREAD__)
#include <sanitizer/tsan_interface.h>
#endif

namespace throng {

/// Calls body(begin, end) over disjoint ranges that cover [0, count). The bodies must be
/// independent of each other, so that the result does not depend on the number of threads.
template <typename Body>
void parallel_ranges(std::size_t count, std::size_t grain, const Body& body) {
  if (count == 0) return;
#if defined(__SANITIZE_THREAD__)
  // TBB itself is not instrumented: tell ThreadSanitizer of its fork and join.
  char fork = 0;
  char join = 0;
  __tsan_release(&fork);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      __tsan_acquire(&fork);
                      body(range.begin(), range.end());
                      __tsan_release(&join);
                    });
  __tsan_acquire(&join);
#else
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, count, grain),
      [&](const tbb::blocked_range<std::size_t>& range) { body(range.begin(), range.end()); });
#endif
}

}  // namespace throng
