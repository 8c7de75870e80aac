// Loops over independent items on TBB's threads.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#if defined(THRONG_SANITIZE_THREAD)
#include <sanitizer/tsan_interface.h>
#endif

namespace throng {

/// Calls body(begin, end) over disjoint ranges that cover [0, count). The bodies must be
/// independent of each other, so that the result does not depend on the number of threads.
template <typename Body>
void parallel_ranges(std::size_t count, std::size_t grain, const Body& body) {
  if (count == 0) return;
#if defined(THRONG_SANITIZE_THREAD)
  // TBB itself is not instrumented: inform ThreadSanitizer of its fork and join.
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

/// Limits the loops of what it runs to some threads, the calling one among them.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads) : arena_(threads) {}

  /// Returns what `act` returns. Exceptions pass.
  template <typename Act>
  auto run(const Act& act) {
    return arena_.execute(act);
  }

 private:
  tbb::task_arena arena_;
};

/// A value per thread of a loop. Values are created before the loop, so that threads that join
/// later allocate nothing.
template <typename T>
class PerThread {
 public:
  explicit PerThread(const T& initial) : initial_(initial) {}

  /// Must be called before the loop, by the thread that starts it.
  void prepare() {
    const auto threads = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
    if (all_.size() < threads) all_.resize(threads, Padded{initial_});
  }
  /// Returns the value of the calling thread; called in the loop.
  T& local() {
    const int index = tbb::this_task_arena::current_thread_index();
    return all_[static_cast<std::size_t>(std::max(index, 0))].value;
  }

 private:
  struct alignas(128) Padded {  // separate cache lines
    T value;
  };

  T initial_;
  std::vector<Padded> all_;
};

}  // namespace throng
