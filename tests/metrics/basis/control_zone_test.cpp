#include "metrics/basis/control_zone.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/compute/random.h"
#include "tests/metrics/walks.h"

namespace throng::metrics {
namespace {

using Eigen::Vector2d;
using world::Building;

TEST(ControlZone, IsHalfADiscOnTheInnerSide) {
  const ControlZone narrow(door(1.2), {});
  EXPECT_DOUBLE_EQ(narrow.radius_m(), 3);
  EXPECT_NEAR(narrow.area_m2(), std::numbers::pi * 9 / 2, 1e-9);
  const ControlZone wide(door(4), {});
  EXPECT_DOUBLE_EQ(wide.radius_m(), 5);

  EXPECT_TRUE(narrow.contains({-0.1, 0}));
  EXPECT_TRUE(narrow.contains({-0.1, 2.9}));
  EXPECT_FALSE(narrow.contains({0.1, 0}));
  EXPECT_FALSE(narrow.contains({-0.1, 3.1}));
}

TEST(ControlZone, WallsInLineWithTheDoorTakeNothingOfIt) {
  Random random(7, Stream::crowd_generator);
  for (int i = 0; i < 1500; ++i) {
    const double turn_rad =
        i % 2 == 0 ? 0.5 * std::numbers::pi * (i / 2 % 4) : random.uniform(0, 2 * std::numbers::pi);
    const Vector2d outward(std::cos(turn_rad), std::sin(turn_rad));
    const Vector2d along(-outward.y(), outward.x());
    const double width_m = random.uniform(0.6, 2.5);
    world::Exit exit;
    const Vector2d middle(random.uniform(-30, 30), random.uniform(-30, 30));
    exit.from = middle - 0.5 * width_m * along;
    exit.to = middle + 0.5 * width_m * along;
    exit.outward = outward;
    std::vector<Building> walls;
    for (const double side : {-1.0, 1.0}) {
      const Vector2d jamb = middle + side * 0.5 * width_m * along;
      const Vector2d end = jamb + side * 8 * along;
      std::vector<Vector2d> corners = {jamb, jamb + 0.3 * outward, end + 0.3 * outward, end};
      if (side < 0) std::reverse(corners.begin(), corners.end());
      walls.push_back({"wall", corners, 3});
    }
    const ControlZone free(exit, {});
    EXPECT_NEAR(ControlZone(exit, walls).area_m2(), free.area_m2(), 1e-6) << i;
  }
}

TEST(ControlZone, TurnsWithTheExit) {
  world::Exit exit = door(2);
  const Vector2d middle(5, -7);
  exit.outward = Vector2d(0.6, -0.8);
  const Vector2d along(0.8, 0.6);
  exit.from = middle - along;
  exit.to = middle + along;
  const ControlZone zone(exit, {});
  EXPECT_TRUE(zone.contains(middle - 2 * exit.outward));
  EXPECT_FALSE(zone.contains(middle + 0.5 * exit.outward));
}

TEST(ControlZone, AHalfDiscCutByAWallHasAQuarterLeft) {
  const std::vector<Building> wall = {box({-50, 0}, {50, 50})};
  EXPECT_NEAR(ControlZone(door(2), wall).area_m2(), std::numbers::pi * 9 / 4, 1e-3);
}

TEST(ControlZone, KnowsWhichShareOfAWayIsInIt) {
  const ControlZone zone(door(2), {});
  EXPECT_NEAR(zone.share_of_path({-4, 0}, {0, 0}), 0.75, 1e-12);
  EXPECT_NEAR(zone.share_of_path({1, 0}, {-1, 0}), 0.5, 1e-12);
  EXPECT_NEAR(zone.share_of_path({-1, -4}, {-1, 4}), std::sqrt(8.0) / 4, 1e-12);
  EXPECT_EQ(zone.share_of_path({-2, 0}, {-1, 0}), 1);
  EXPECT_EQ(zone.share_of_path({-1, 0}, {-1, 0}), 1);
  EXPECT_EQ(zone.share_of_path({1, 0}, {1, 0}), 0);
  EXPECT_EQ(zone.share_of_path({1, -4}, {1, 4}), 0) << "outside of the door";
  EXPECT_EQ(zone.share_of_path({-4, 4}, {-4, -4}), 0) << "past the disc";
  EXPECT_EQ(zone.share_of_path({-9, 0}, {-5, 0}), 0) << "not there yet";
}

TEST(ControlZone, HasNoAreaInsideABuilding) {
  const std::vector<Building> block = {box({-50, -50}, {50, 50})};
  EXPECT_NEAR(ControlZone(door(2), block).area_m2(), 0, 1e-9);
}

// Buildings that overlap, share edges, are concave, stick out of the disc or miss it.
class ZoneAmongBuildings : public ::testing::TestWithParam<std::vector<Building>> {};

TEST_P(ZoneAmongBuildings, AreaAgreesWithWhereItsPointsAre) {
  const ControlZone zone(door(2), GetParam());
  Random random(11, Stream::crowd_generator);
  constexpr int kSamples = 200000;
  int hits = 0;
  for (int i = 0; i < kSamples; ++i) {
    if (zone.contains({random.uniform(-3, 0), random.uniform(-3, 3)})) ++hits;
  }
  const double share = hits / static_cast<double>(kSamples);
  const double four_sigma = 4 * std::sqrt(share * (1 - share) / kSamples) * 18;
  EXPECT_NEAR(zone.area_m2(), 18 * share, four_sigma);
}

INSTANTIATE_TEST_SUITE_P(
    Layouts, ZoneAmongBuildings,
    ::testing::Values(
        std::vector<Building>{box({-6, 1}, {0, 15}), box({-6, -15}, {0, -1})},
        std::vector<Building>{box({-2, -1}, {-1, 1}), box({-1.5, 0}, {-0.5, 2})},
        std::vector<Building>{box({-2, -1}, {-1, 1}), box({-1, -1}, {-0.5, 1}),
                              box({-2, 1}, {-0.5, 2})},
        std::vector<Building>{
            {"L", {{-2.5, -2}, {-0.3, -2}, {-0.3, -1.5}, {-2, -1.5}, {-2, 1}, {-2.5, 1}}, 5}},
        std::vector<Building>{box({5, 5}, {6, 6}), box({-2.9, -2.9}, {-2.8, -2.8})}));

}  // namespace
}  // namespace throng::metrics
