// A step allocates nothing once everything has its size. Not with ThreadSanitizer, which defines
// operator new itself.
#if !defined(THRONG_SANITIZE_THREAD)
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "tests/crowd/crowd_files.h"
#include "tests/crowd/model_scenes.h"

namespace {

std::atomic<long> allocations{0};

}  // namespace

// Not inlined: the compiler would take malloc and delete for a mismatch.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) return memory;  // NOLINT(cppcoreguidelines-owning-memory)
  throw std::bad_alloc();
}

[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  ++allocations;
  return std::malloc(size);  // NOLINT(cppcoreguidelines-owning-memory)
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

class AllocationOfModel : public testing::TestWithParam<std::string> {};

TEST_P(AllocationOfModel, AStepAllocatesNothingAfterWarmUp) {
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism, 1);
  const std::string modifier = R"(<VelModifier type="fundamental_diagram" factor_dist="c"
      factor_value="1.57" buffer_dist="c" buffer_value="0.9"/>)";
  Simulation crowd = test::load(
      test::model_scene(test::agent_at(0, 0) + test::agent_at(0.5, 0.1) + test::agent_at(1, 0), "",
                        test::box(3, -4, 4, 4)),
      test::eastward_behavior(modifier), {.model = GetParam()});
  for (int i = 0; i < 20; ++i) crowd.step();
  const long before = allocations;
  for (int i = 0; i < 100; ++i) crowd.step();
  EXPECT_EQ(allocations - before, 0);
}

INSTANTIATE_TEST_SUITE_P(Models, AllocationOfModel,
                         testing::Values("weidmann", "ttc", "pedvo", "johannson", "karamouzas",
                                         "zanlungo", "gcf", "dummy"));

}  // namespace
}  // namespace throng::crowd
#endif
