#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <chrono>
#include <ctime>
#include <functional>
#include <thread>

#include "crowd/state/model.h"
#include "tests/base/wait_until.h"
#include "tests/crowd/crowd_files.h"
#include "tests/crowd/model_scenes.h"

namespace throng::crowd {
namespace {

struct Outcome {
  std::vector<Eigen::Vector2f> positions;
  std::vector<float> yaws;
  std::vector<std::uint8_t> states;
  bool operator==(const Outcome&) const = default;
};

Outcome run_to_end(const Simulation& crowd) {
  return {{crowd.positions().begin(), crowd.positions().end()},
          {crowd.yaws_rad().begin(), crowd.yaws_rad().end()},
          {crowd.states().begin(), crowd.states().end()}};
}

/// With as many threads, whatever the machine has.
void with_threads(int threads, const std::function<void()>& action) {
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  arena.execute(action);
}

Outcome run_city_square(std::uint64_t seed, int threads) {
  Outcome outcome;
  with_threads(threads, [&] {
    Simulation crowd = test::load_city_square(seed);
    for (int i = 0; i < 300; ++i) {
      crowd.move_goal(99, 0, {-10 + 0.1F * static_cast<float>(i), 5});
      crowd.step();
    }
    outcome = run_to_end(crowd);
  });
  return outcome;
}

constexpr int kCrowd = 700;  // more than one thread's share

Outcome run_model(std::string_view model, int threads) {
  Outcome outcome;
  with_threads(threads, [&] {
    Simulation crowd =
        test::load(test::model_crowd_scene(kCrowd), test::to_point_behavior(5, 4),
                   {.model = std::string(model), .separation = BodySeparation::hard});
    for (int i = 0; i < 60; ++i) crowd.step();
    outcome = run_to_end(crowd);
  });
  return outcome;
}

TEST(Determinism, ThreadsDoNotChangeASingleBit) {
  const Outcome one = run_city_square(5, 1);
  EXPECT_TRUE(one == run_city_square(5, 2));
  EXPECT_TRUE(one == run_city_square(5, 16));
}

TEST(Determinism, ThreadsDoNotChangeASingleBitOfAnyModel) {
  for (const ModelEntry& model : models()) {
    EXPECT_TRUE(run_model(model.name, 1) == run_model(model.name, 16)) << model.name;
  }
}

TEST(Determinism, AnotherSeedIsAnotherRun) {
  EXPECT_FALSE(run_city_square(5, 2) == run_city_square(6, 2));
}

TEST(Threads, SleepWhenThereIsNothingToDo) {
  run_model("orca", 16);
  // The processor time that the whole process uses while its main thread sleeps. They fall asleep
  // when they have found nothing to do for a while, for which they need a processor.
  const auto used_while_asleep = [] {
    const std::clock_t before = std::clock();
    std::this_thread::sleep_for(std::chrono::milliseconds(400));
    return std::clock() - before;
  };
  EXPECT_TRUE(wait_until([&] { return used_while_asleep() < CLOCKS_PER_SEC / 50; }));
}

}  // namespace
}  // namespace throng::crowd
