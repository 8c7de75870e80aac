#include "metrics/basis/crossings.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/compute/random.h"
#include "tests/metrics/walks.h"

namespace throng::metrics {
namespace {

using Eigen::Vector2d;

int net_crossings(const std::vector<Vector2d>& path, double width_m = 2, double margin_m = 0.2) {
  const ExitLine line(door(width_m), margin_m, margin_m);
  CrossingCounter counter;
  int net = 0;
  for (const Vector2d& position : path) net += counter.step(line, position);
  return net;
}

TEST(Crossings, CountOutwardAndInwardWithSign) {
  EXPECT_EQ(net_crossings({{-1, 0}, {-0.1, 0}, {0.1, 0}, {1, 0}}), 1);
  EXPECT_EQ(net_crossings({{1, 0}, {0.1, 0}, {-0.1, 0}, {-1, 0}}), -1);
  EXPECT_EQ(net_crossings({{-1, 0}, {1, 0}, {-1, 0}}), 0);
  EXPECT_EQ(net_crossings({{-1, 0}, {1, 0}, {-1, 0}, {1, 0}}), 1);
}

TEST(Crossings, OneStepAcrossTheWholeDoorIsSeen) {
  EXPECT_EQ(net_crossings({{-50, 0}, {50, 0}}), 1);
  // Starts and ends beside the door's width, yet passes through its middle.
  EXPECT_EQ(net_crossings({{-50, -30}, {50, 30}}), 1);
  // Starts and ends before the door, yet crosses the line elsewhere.
  EXPECT_EQ(net_crossings({{-0.5, 0}, {0.5, 10}}), 0);
}

TEST(Crossings, OnlyTheDoorWithItsMarginCounts) {
  EXPECT_EQ(net_crossings({{-1, 1.19}, {1, 1.19}}), 1);
  EXPECT_EQ(net_crossings({{-1, 1.21}, {1, 1.21}}), 0);
  EXPECT_EQ(net_crossings({{-1, -5}, {1, -5}}), 0);
}

TEST(Crossings, LeavingElsewhereAndReturningThroughTheDoorIsAnEntry) {
  EXPECT_EQ(net_crossings({{-1, 5}, {1, 5}, {1, 0}, {-1, 0}}), -1);
}

TEST(Crossings, SomebodyWhoWalksAroundTheBuildingOutsideHasLeft) {
  const ExitLine line(door(2), 0.2, 0.2);
  CrossingCounter counter;
  for (const Vector2d& position : {Vector2d(-1, 0), Vector2d(1, 0), Vector2d(1, 30)}) {
    counter.step(line, position);
  }
  counter.step(line, {-5, 30});
  EXPECT_TRUE(counter.has_left());
  counter.step(line, {1, 30});
  counter.step(line, {1, 0});
  counter.step(line, {-1, 0});
  EXPECT_FALSE(counter.has_left()) << "back through the door";
}

TEST(Crossings, JitterOnTheLineCountsOnceAtMost) {
  Random random(5, Stream::motion);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<Vector2d> path = {{-2, 0}};
    for (int i = 0; i < 100; ++i) path.emplace_back(random.uniform(-0.19, 0.19), 0);
    EXPECT_EQ(net_crossings(path), 0);
    path.emplace_back(2, 0);
    EXPECT_EQ(net_crossings(path), 1);
  }
}

TEST(Crossings, ARandomWalkCrossesAsItsEndsSay) {
  Random random(6, Stream::motion);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<Vector2d> path = {{-1, 0}};
    for (int i = 0; i < 300; ++i) {
      path.emplace_back(path.back() + Vector2d(random.normal(0, 0.3), 0));
    }
    const bool ends_outside = random.below(2) == 1;
    path.emplace_back(ends_outside ? 1 : -1, 0);
    EXPECT_EQ(net_crossings(path), ends_outside ? 1 : 0);
  }
}

}  // namespace
}  // namespace throng::metrics
