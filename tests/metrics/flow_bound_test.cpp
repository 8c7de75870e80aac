#include "metrics/flow_bound.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include "base/random.h"

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

// One door of 2 /s and people who come as they come: the k-th of them is out when they are there,
// or half a second after the one before, whichever is later.
TEST(EarliestOut, AtOneDoorIsTheQueueOfArrivals) {
  Departures departures;
  departures.capacity_per_s = {2};
  departures.on_s = {3};
  for (const double access_s : {1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 20.0, 21.0}) {
    departures.access_s.push_back({access_s});
  }
  EXPECT_EQ(earliest_out_s(departures), (std::vector<double>{3, 3, 4, 4, 5, 5, 22, 23}));
}

// Who can take either door must leave the near one to those who cannot: only rerouting finds that.
TEST(EarliestOut, PeopleMakeRoomForThoseWhoHaveNoChoice) {
  const double never = std::numeric_limits<double>::infinity();
  Departures departures;
  departures.capacity_per_s = {1, 1};
  departures.on_s = {0, 0};
  departures.access_s = {{1, 1},     {1, 1},     {1, 1},        {1, never},
                         {1, never}, {1, never}, {never, never}};
  EXPECT_EQ(earliest_out_s(departures), (std::vector<double>{0, 0, 1, 1, 2, 2, never}));
}

// Against all assignments of a few people to doors: with an assignment, each door serves in the
// order of arrival.
TEST(EarliestOut, NobodyGetsOutByADoorThatIsShut) {
  // Two a second until it shuts after 3 s; of two who can go to another door, one per second.
  constexpr double never = std::numeric_limits<double>::infinity();
  Departures departures;
  departures.capacity_per_s = {2, 1};
  departures.on_s = {0, 0};
  departures.shuts_s = {3, never};
  for (int i = 0; i < 8; ++i) departures.access_s.push_back({0, i < 2 ? 0 : never});
  EXPECT_EQ(earliest_out_s(departures), (std::vector<double>{0, 0, 0, 1, 1, 1, 2, 2}));
  departures.shuts_s = {2, never};
  EXPECT_EQ(earliest_out_s(departures), (std::vector<double>{0, 0, 0, 1, 1, 1, never, never}));
  departures.shuts_s = {-5, never};
  EXPECT_EQ(earliest_out_s(departures),
            (std::vector<double>{0, 1, never, never, never, never, never, never}));
}

TEST(EarliestOut, IsTheBestOfAllAssignmentsAtEveryTime) {
  Random random(3, Stream::wind);
  for (int trial = 0; trial < 60; ++trial) {
    constexpr int kPeople = 7;
    Departures departures;
    departures.capacity_per_s = {1, 2};
    departures.on_s = {static_cast<double>(random.below(4)), static_cast<double>(random.below(4))};
    for (int i = 0; i < kPeople; ++i) {
      departures.access_s.push_back({1.0 + random.below(8), 1.0 + random.below(8)});
    }
    std::vector<double> best(kPeople, 1e9);  // of every assignment, the k-th person out
    for (int assignment = 0; assignment < 1 << kPeople; ++assignment) {
      std::vector<double> out_s;
      for (int exit = 0; exit < 2; ++exit) {
        std::vector<int> arrivals;
        for (int i = 0; i < kPeople; ++i) {
          if ((assignment >> i & 1) == exit) {
            arrivals.push_back(static_cast<int>(departures.access_s[i][exit]) - 1);
          }
        }
        std::sort(arrivals.begin(), arrivals.end());
        std::map<int, int> used;
        int second = 0;
        for (const int arrival : arrivals) {
          second = std::max(second, arrival);
          if (used[second] == departures.capacity_per_s[exit]) ++second;
          ++used[second];
          out_s.push_back(second + departures.on_s[exit]);
        }
      }
      std::sort(out_s.begin(), out_s.end());
      for (int i = 0; i < kPeople; ++i) best[i] = std::min(best[i], out_s[i]);
    }
    EXPECT_EQ(earliest_out_s(departures), best) << trial;
  }
}

TEST(FlowBound, NobodyOrNoWayOut) {
  world::Scenario place = hall();
  EXPECT_EQ(flow_bound(place, {}, {2, {1, 1}}).t100_s, 0);
  for (world::Exit& exit : place.exits) exit.open = false;
  EXPECT_TRUE(std::isinf(flow_bound(place, {{0, 0}}, {2, {1, 1}}).t90_s));
}

}  // namespace
}  // namespace throng::metrics
