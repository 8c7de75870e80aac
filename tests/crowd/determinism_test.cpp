#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "crowd_files.h"

namespace throng::crowd {
namespace {

struct Outcome {
  std::vector<Eigen::Vector2f> positions;
  std::vector<float> yaws;
  std::vector<std::uint8_t> states;
  bool operator==(const Outcome&) const = default;
};

Outcome run_city_square(std::uint64_t seed, std::size_t threads) {
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
  Simulation crowd = test::load_city_square(seed);
  for (int i = 0; i < 300; ++i) {
    crowd.move_goal(99, 0, {-10 + 0.1F * static_cast<float>(i), 5});
    crowd.step();
  }
  return {{crowd.positions().begin(), crowd.positions().end()},
          {crowd.yaws_rad().begin(), crowd.yaws_rad().end()},
          {crowd.states().begin(), crowd.states().end()}};
}

TEST(Determinism, ThreadsDoNotChangeASingleBit) {
  const Outcome one = run_city_square(5, 1);
  EXPECT_TRUE(one == run_city_square(5, 2));
  EXPECT_TRUE(one == run_city_square(5, 8));
}

TEST(Determinism, AnotherSeedIsAnotherRun) {
  EXPECT_FALSE(run_city_square(5, 2) == run_city_square(6, 2));
}

}  // namespace
}  // namespace throng::crowd
