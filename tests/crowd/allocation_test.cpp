// A step allocates nothing once everything has its size.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "crowd_files.h"

namespace {

std::atomic<long> allocations{0};

}  // namespace

// Not inlined: the compiler would take malloc and delete for a mismatch.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) return memory;  // NOLINT(cppcoreguidelines-owning-memory)
  throw std::bad_alloc();
}

[[gnu::noinline]] void operator delete(void* memory) noexcept {
  std::free(memory);  // NOLINT(cppcoreguidelines-owning-memory)
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);  // NOLINT(cppcoreguidelines-owning-memory)
}

namespace throng::crowd {
namespace {

TEST(Allocation, AStepAllocatesNothingAfterWarmUp) {
  // One thread: each has its own workspace, and others may join at any step.
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism, 1);
  Simulation crowd = test::load_city_square(1);
  for (int i = 0; i < 20; ++i) crowd.step();
  const long before = allocations;
  for (int i = 0; i < 400; ++i) crowd.step();
  EXPECT_EQ(allocations - before, 0);
}

}  // namespace
}  // namespace throng::crowd
