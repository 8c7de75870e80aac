#include "metrics/bounds/flow_bound.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include "base/compute/random.h"

namespace throng::metrics {
namespace {

using Eigen::Vector2d;

/// Two doors in the sides of a square of 20 m, straight walks at 2 m/s; out is right behind them.
Departures hall(const std::vector<Vector2d>& people, double left_per_s, double right_per_s) {
  Departures departures;
  departures.capacity_per_s = {left_per_s, right_per_s};
  departures.on_s = {0, 0};
  for (const Vector2d& person : people) {
    departures.access_s.push_back(
        {(person - Vector2d(-10, 0)).norm() / 2, (person - Vector2d(10, 0)).norm() / 2});
  }
  return departures;
}

TEST(EarliestOut, ManyAtADoorAreLimitedByTheDoors) {
  const auto out_s = earliest_out_s(hall(std::vector<Vector2d>(100, Vector2d(-10, 0)), 2, 0));
  EXPECT_NEAR(out_s.back(), 50, 1);
  EXPECT_NEAR(out_s[49], 25, 1);
}

TEST(EarliestOut, FewFarAwayAreLimitedByTheirSpeed) {
  EXPECT_NEAR(earliest_out_s(hall({{0, 0}, {0, 0}}, 5, 5)).back(), 5, 1);
}

TEST(EarliestOut, TheBestShareUsesBothDoors) {
  // All stand at the left door; 10 s on foot from the right one. Rates 2 and 2: until T the left
  // lets out 2 T, the right 2 (T - 10): 100 in all for T = 30.
  const std::vector<Vector2d> people(100, Vector2d(-10, 0));
  EXPECT_NEAR(earliest_out_s(hall(people, 2, 2)).back(), 30, 1.5);
}

TEST(EarliestOut, PeopleGoWhereTheyAreNeeded) {
  // 30 near the left door and 30 in the middle: who is in the middle must all go right.
  std::vector<Vector2d> people(30, Vector2d(-10, 0));
  people.insert(people.end(), 30, Vector2d(0, 0));
  EXPECT_NEAR(earliest_out_s(hall(people, 1, 1)).back(), 33, 2);
}

// The slots of a door with burst 3 and 0.5 /s, from the second in which the first one comes: 3 at
// once, the fourth after 2 s more, and so on.
TEST(EarliestOut, ABurstPassesAtOnceAndOnlyFromTheFirstArrivalOn) {
  Departures departures;
  departures.capacity_per_s = {0.5};
  departures.burst = {3};
  departures.on_s = {1};
  for (int i = 0; i < 6; ++i) departures.access_s.push_back({10.5});
  EXPECT_EQ(earliest_out_s(departures), (std::vector<double>{11, 11, 11, 12, 14, 16}));
}

// The same door, at which one person is early: those who come later find it rested, as if nobody
// had passed, but not with more than its burst.
TEST(EarliestOut, ADoorRestsWhileNobodyComes) {
  Departures departures;
  departures.capacity_per_s = {0.5};
  departures.burst = {3};
  departures.on_s = {1};
  departures.access_s = {{0.5}};
  for (int i = 0; i < 6; ++i) departures.access_s.push_back({30.5});
  EXPECT_EQ(earliest_out_s(departures), (std::vector<double>{1, 31, 31, 31, 32, 34, 36}));
}

// People who pass a door at random times are never out before the earliest, if its burst is the
// least that allows their passages in all slots in a row, found here by trying all of them.
TEST(EarliestOut, AllowsAllPassagesWithinTheBurst) {
  Random random(5, Stream::wind);
  for (int trial = 0; trial < 300; ++trial) {
    const double rate_per_s = random.uniform(0.2, 3);
    std::vector<double> passages_s;
    const int people = 1 + static_cast<int>(random.uniform(0, 40));
    const double spread_s = random.uniform(1, 60);
    for (int i = 0; i < people; ++i) {
      const bool in_a_group = i > 0 && random.uniform(0, 1) < 0.6;
      passages_s.push_back(in_a_group ? passages_s.back() + random.uniform(0, 0.3)
                                      : random.uniform(0, spread_s));
    }
    std::sort(passages_s.begin(), passages_s.end());
    double burst = 0;
    for (std::size_t first = 0; first < passages_s.size(); ++first) {
      for (std::size_t last = first; last < passages_s.size(); ++last) {
        const double slots = std::floor(passages_s[last]) - std::floor(passages_s[first]) + 1;
        burst = std::max(burst, static_cast<double>(last - first + 1) - rate_per_s * slots);
      }
    }
    Departures departures;
    departures.capacity_per_s = {rate_per_s};
    departures.burst = {burst};
    departures.on_s = {0};
    for (const double passage_s : passages_s) {
      departures.access_s.push_back({passage_s - random.uniform(0, 3)});
    }
    const auto out_s = earliest_out_s(departures);
    for (std::size_t i = 0; i < out_s.size(); ++i) {
      EXPECT_LE(out_s[i], passages_s[i]) << "trial " << trial << ", person " << i;
    }
  }
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

// People who can take either door must leave the near one to those who cannot: only rerouting finds
// that.
TEST(EarliestOut, PeopleMakeRoomForOthersWithoutAChoice) {
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
  departures.closes_at_s = {3, never};
  for (int i = 0; i < 8; ++i) departures.access_s.push_back({0, i < 2 ? 0 : never});
  EXPECT_EQ(earliest_out_s(departures), (std::vector<double>{0, 0, 0, 1, 1, 1, 2, 2}));
  departures.closes_at_s = {2, never};
  EXPECT_EQ(earliest_out_s(departures), (std::vector<double>{0, 0, 0, 1, 1, 1, never, never}));
  departures.closes_at_s = {-5, never};
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

TEST(EarliestOut, NobodyOrNoWayOut) {
  EXPECT_TRUE(earliest_out_s(hall({}, 1, 1)).empty());
  EXPECT_TRUE(std::isinf(earliest_out_s(hall({{0, 0}}, 0, 0)).front()));
}

}  // namespace
}  // namespace throng::metrics
