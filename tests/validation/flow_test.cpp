// Scenes of the suite and what is measured in them.
#include "validation/flow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "validation/floors.h"
#include "validation/run.h"
#include "validation/walking.h"

namespace throng::validation {
namespace {

TEST(WeidmannSpeed, IsThePublishedCurve) {
  EXPECT_DOUBLE_EQ(weidmann_speed_mps(0), 1.34);
  EXPECT_NEAR(weidmann_speed_mps(1), 1.058, 5e-4);
  EXPECT_NEAR(weidmann_speed_mps(1.75) * 1.75, 1.22, 0.01) << "the greatest flow";
  EXPECT_DOUBLE_EQ(weidmann_speed_mps(5.4), 0);
  EXPECT_DOUBLE_EQ(weidmann_speed_mps(8), 0);
}

TEST(Ring, HoldsItsPeopleInsideAndMeasuresTheirSpeed) {
  Ring spec;
  spec.people = 40;
  spec.speed = Sampled::constant(1.2);
  crowd::Simulation crowd = load(ring(spec), {"orca"}, 1);
  EXPECT_EQ(crowd.agent_count(), 40);
  EXPECT_NEAR(mean_ring_speed(crowd, 5, 20), 1.2, 0.02);
  for (const Eigen::Vector2f& p : crowd.positions()) {
    EXPECT_GT(p.norm(), 11.0F);
    EXPECT_LT(p.norm(), 14.0F);
  }
}

TEST(Bottleneck, PassesMorePerSecondWhenWider) {
  const double narrow = 0.8 * specific_flow({"orca"}, {0.8, 0.2, 60}, 1);
  const double wide = 2.0 * specific_flow({"orca"}, {2.0, 0.2, 60}, 1);
  EXPECT_GT(narrow, 0.5);
  EXPECT_GT(wide, 1.5 * narrow);
}

TEST(Bottleneck, HasNoFlowWhereNobodyFits) {
  EXPECT_EQ(specific_flow({"orca"}, {0.3, 0.2, 20}, 1), 0);
}

TEST(Bottleneck, PassesAsManyWhateverItsCornersAre) {
  for (const double width_m : {0.5, 0.8}) {
    const double square = specific_flow({"ttc"}, {width_m, 1.1, 75, 1.8, 0}, 1);
    const double cut = specific_flow({"ttc"}, {width_m, 1.1, 75, 1.8, 0.15}, 1);
    EXPECT_GT(square, 1.5) << "people walk past the jambs of a door of " << width_m << " m";
    EXPECT_GT(square, 0.8 * cut);
    EXPECT_GT(cut, 0.8 * square);
  }
}

TEST(Bottleneck, CutsItsCornersAsFarAsThereIsWall) {
  // The last two walls are those beside the door.
  const TestScene narrow = room_with_door({1.2, 0.1, 40, 1.8, 0.5});
  for (std::size_t wall = 3; wall < 5; ++wall) {
    for (const Eigen::Vector2d& corner : narrow.walls[wall]) {
      EXPECT_GE(std::abs(corner.y()), 0.6) << "the door keeps its width";
      EXPECT_GE(corner.x(), 0);
      EXPECT_LE(corner.x(), 0.1);
    }
    EXPECT_EQ(narrow.walls[wall].size(), 4) << "no corner is there twice";
  }
  EXPECT_EQ(room_with_door({1.2, 0.4, 40, 5, 0.15}).walls[3].size(), 5);
}

TEST(TwoWayCorridor, FlowsForTenMinutes) {
  const TwoWayRun run = walk_both_ways({"ttc"}, 0.75, 1);
  EXPECT_LE(run.stuck, 0.02);
  EXPECT_GT(std::min(run.there, run.back), 0.6);
}

TEST(Lattice, FillsItsBox) {
  const auto places = lattice({-1, 2}, {3, 4}, 50);
  ASSERT_EQ(places.size(), 50);
  for (const Eigen::Vector2d& p : places) {
    EXPECT_GT(p.x(), -1);
    EXPECT_LT(p.x(), 3);
    EXPECT_GT(p.y(), 2);
    EXPECT_LT(p.y(), 4);
  }
}

TEST(Room, HasOneWallPieceMoreThanDoorsOnASide) {
  EXPECT_EQ(room(8, 5, {}).size(), 4);
  EXPECT_EQ(room(8, 5, {{Side::left, 1, 1}, {Side::left, 3, 1}, {Side::top, 4, 1}}).size(), 7);
}

TEST(UntilAllLeft, GivesUpOnAJam) {
  TestScene scene;
  scene.walls = room(4, 4, {});
  Group group;
  group.places = {{2, 2}};
  scene.groups = {group};
  scene.behavior.goal_box(0, 10, 1, 11, 2).walk_to(0).leave_at_goal();
  crowd::Simulation crowd = load(scene, {"weidmann"}, 1);
  EXPECT_FALSE(until_all_left(crowd, 1000));
  EXPECT_LT(crowd.time_s(), 200);
}

}  // namespace
}  // namespace throng::validation
