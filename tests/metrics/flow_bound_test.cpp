#include "metrics/flow_bound.h"

#include <gtest/gtest.h>

#include <cmath>

namespace throng::metrics {
namespace {

using Eigen::Vector2d;

/// Two doors in the sides of a square of 20 m; out is right behind them.
world::Scenario hall() {
  world::Scenario place;
  place.inside = {{-10, -10}, {10, 10}};
  place.exits = {{"left", {-10, -1}, {-10, 1}, {-1, 0}, true, {}},
                 {"right", {10, -1}, {10, 1}, {1, 0}, true, {}}};
  return place;
}

TEST(FlowBound, ManyAtADoorAreLimitedByTheDoors) {
  const std::vector<Vector2d> people(100, Vector2d(-10, 0));
  world::Scenario place = hall();
  place.exits[1].open = false;
  const FlowBound bound = flow_bound(place, people, {2, {2, 5}});
  EXPECT_NEAR(bound.t100_s, 50, 1);
  EXPECT_NEAR(bound.t50_s, 25, 1);
  EXPECT_NEAR(bound.mean_s, 25, 1);
}

TEST(FlowBound, FewFarAwayAreLimitedByTheirSpeed) {
  const FlowBound bound = flow_bound(hall(), {{0, 0}, {0, 0}}, {2, {5, 5}});
  EXPECT_NEAR(bound.t100_s, 5, 1);
  EXPECT_NEAR(bound.mean_s, 5, 1);
}

TEST(FlowBound, TheBestShareUsesBothDoors) {
  // All stand at the left door; 10 s on foot from the right one. Rates 2 and 2: until T the left
  // lets out 2 T, the right 2 (T - 10): 100 in all for T = 30.
  const std::vector<Vector2d> people(100, Vector2d(-10, 0));
  EXPECT_NEAR(flow_bound(hall(), people, {2, {2, 2}}).t100_s, 30, 1.5);
}

TEST(FlowBound, PeopleGoWhereTheyAreNeeded) {
  // 30 near the left door and 30 in the middle: who is in the middle must all go right.
  std::vector<Vector2d> people(30, Vector2d(-10, 0));
  people.insert(people.end(), 30, Vector2d(0, 0));
  EXPECT_NEAR(flow_bound(hall(), people, {2, {1, 1}}).t100_s, 33, 2);
}

TEST(FlowBound, NobodyOrNoWayOut) {
  world::Scenario place = hall();
  EXPECT_EQ(flow_bound(place, {}, {2, {1, 1}}).t100_s, 0);
  for (world::Exit& exit : place.exits) exit.open = false;
  EXPECT_TRUE(std::isinf(flow_bound(place, {{0, 0}}, {2, {1, 1}}).t90_s));
}

}  // namespace
}  // namespace throng::metrics
