// Measures of people whose paths are known: constant speeds, gaps and directions.
#include "validation/experiments/walks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tests/validation/experiments/recordings.h"

namespace throng::validation {
namespace {

using Eigen::Vector2d;

std::vector<std::string> names(const Measures& measures) {
  std::vector<std::string> all;
  for (const Quantity& quantity : measures.quantities) all.push_back(quantity.name);
  return all;
}

/// Somebody enters the corridor each `gap_s` at x = 0, at 1.25 m/s.
Walks procession(std::size_t people, double gap_s, double dt_s) {
  Walks walks{dt_s, {}};
  for (std::size_t i = 0; i < people; ++i) {
    walks.people.push_back(
        straight_walk({gap_s * static_cast<double>(i), {0, 1}, {1.25, 0}, 14}, dt_s));
  }
  return walks;
}

TEST(Measures, AreThoseOfAProcession) {
  for (const double dt_s : {0.1, 0.04, 0.0625}) {
    const Walks walks = procession(50, 0.5, dt_s);
    const Measures measures = measure(walks, corridor(), {12, 25});
    EXPECT_EQ(measures.people, 50U);
    ASSERT_EQ(measures.passages_s.size(), 50U);
    EXPECT_NEAR(measures.passages_s.front(), 8, 1e-9);
    EXPECT_NEAR(value(measures, "flow"), 1 / 0.5 / 2, 0.01) << "2 people a second over 2 m";
    EXPECT_NEAR(value(measures, "density"), 1 / 0.5 / 1.25 / 2, 0.02);
    EXPECT_NEAR(value(measures, "speed"), 1.25, 1e-9);
    EXPECT_NEAR(value(measures, "T90"), 8 + 44 * 0.5, dt_s) << "the 45th of 50 people";
    EXPECT_NEAR(value(measures, "time gap, median"), 0.5, dt_s);
    EXPECT_NEAR(value(measures, "time gap, 90 %"), 0.5, dt_s);
  }
}

TEST(Measures, DoNotCountSwaying) {
  constexpr double kDtS = 0.1;
  Walks walks = procession(50, 0.5, kDtS);
  for (Walk& walk : walks.people) {
    for (std::size_t i = 0; i < walk.places.size(); ++i) {
      walk.places[i].y() += 0.1 * std::sin(M_PI * kDtS * static_cast<double>(i));
    }
  }
  EXPECT_NEAR(value(measure(walks, corridor(), {12, 25}), "speed"), 1.25, 0.005);
}

TEST(Measures, OfTheAreaAreThoseOfItsTimeOnly) {
  const Walks walks = procession(50, 0.5, 0.1);
  EXPECT_EQ(means_in_area(walks, corridor().area, {0, 6}).density, 0);
  EXPECT_TRUE(std::isnan(means_in_area(walks, corridor().area, {0, 6}).speed_mps));
  // One person alone is in the area (4 m) from 6.4 to 9.6 s.
  const Walks one{0.1, {walks.people.front()}};
  EXPECT_NEAR(means_in_area(one, corridor().area, {6.45, 9.55}).density, 1.0 / 8, 1e-9);
}

TEST(Measures, SayThatPeopleDoNotPass) {
  Walks walks{0.1, {}};
  for (int i = 0; i < 10; ++i) {
    walks.people.push_back(straight_walk({0.5 * i, {0, 1}, {1, 0}, i < 8 ? 12.0 : 5.0}, 0.1));
  }
  Measures measures = measure(walks, corridor(), {10, 12});
  EXPECT_EQ(measures.people, 10U);
  EXPECT_EQ(measures.passages_s.size(), 8U);
  EXPECT_TRUE(std::isinf(value(measures, "T90")));
  EXPECT_GT(value(measures, "flow"), 0) << "80 % have passed";
  walks.people.resize(1);
  EXPECT_TRUE(std::isnan(value(measure(walks, corridor(), {10, 12}), "flow")))
      << "one person has no flow";
  Recording elsewhere = corridor();
  elsewhere.line = {{17, 0}, {17, 2}};
  measures = measure(walks, elsewhere, steady_range(walks, elsewhere));
  EXPECT_TRUE(measures.passages_s.empty());
  EXPECT_EQ(value(measures, "speed"), 1) << "the steady state is all the time";
}

TEST(Measures, CountPeopleOnceAndAtTheLineOnly) {
  Walk there_and_back = straight_walk({0, {9, 1}, {1, 0}, 2}, 0.1);
  const Walk back = straight_walk({0, {11, 1}, {-1, 0}, 2}, 0.1);
  there_and_back.places.insert(there_and_back.places.end(), back.places.begin(), back.places.end());
  const Walk beside = straight_walk({0, {9, 3}, {1, 0}, 2}, 0.1);
  const Measures measures = measure({0.1, {there_and_back, beside}}, corridor(), {0, 4});
  ASSERT_EQ(measures.passages_s.size(), 1U);
  EXPECT_NEAR(measures.passages_s[0], 1, 1e-9);
}

/// People of two directions, each in the half of the corridor that `half` says for its number.
Measures both_ways(const std::function<double(int)>& side_there) {
  Recording recording = corridor();
  recording.goals.push_back({Vector2d(0.5, 0.2), Vector2d(2, 1.8)});
  Walks walks{0.1, {}};
  for (int i = 0; i < 40; ++i) {
    const double y = side_there(i);
    walks.people.push_back(straight_walk({0.5 * i, {2, y}, {1, 0}, 16}, 0.1, 0));
    walks.people.push_back(straight_walk({0.5 * i, {18, 2 - y}, {-1, 0}, 16}, 0.1, 1));
  }
  return measure(walks, recording, {16, 20});
}

TEST(BandIndex, IsOneForLanesAndLessForAMixedCrowd) {
  const Measures lanes = both_ways([](int) { return 0.6; });
  EXPECT_NEAR(value(lanes, "band index"), 1, 1e-9);
  EXPECT_NEAR(value(lanes, "flow 1"), 1, 0.02);
  EXPECT_NEAR(value(lanes, "flow 2"), 1, 0.02);
  // Everybody walks in the middle: each band of 0.5 m has as many of one direction as of the other.
  const Measures mixed = both_ways([](int) { return 1.0; });
  EXPECT_NEAR(value(mixed, "band index"), 0, 0.15);
  const Measures half = both_ways([](int i) { return i % 2 == 0 ? 0.6 : 1.0; });
  EXPECT_GT(value(half, "band index"), value(mixed, "band index") + 0.2);
  EXPECT_LT(value(half, "band index"), 0.8);
}

TEST(BandIndex, IsOfPeopleWhoWalkAgainstEachOther) {
  Recording two_exits = corridor();
  two_exits.goals = {{Vector2d(18, 0.1), Vector2d(19, 0.9)},
                     {Vector2d(18, 1.1), Vector2d(19, 1.9)}};
  EXPECT_THAT(names(measure(procession(5, 1, 0.1), two_exits, {8, 10})),
              ::testing::Not(::testing::Contains("band index")));
  EXPECT_THAT(names(measure(procession(5, 1, 0.1), two_exits, {8, 10})),
              ::testing::Contains("flow 2"));
}

TEST(SteadyState, IsFromThe20thToThe80thPercentileOfPassages) {
  const Walks walks = procession(11, 1, 0.1);  // passages at 8, 9, ..., 18 s
  Recording recording = corridor();
  const TimeRange range = steady_range(walks, recording);
  EXPECT_NEAR(range.from_s, 10, 1e-6);
  EXPECT_NEAR(range.until_s, 16, 1e-6);
  recording.steady = TimeRange{3, 4};
  EXPECT_EQ(steady_range(walks, recording).until_s, 4);
}

TEST(CurveDifference, IsThatOfShiftedCurves) {
  std::vector<double> recorded_s;
  std::vector<double> later_s;
  for (int i = 0; i < 100; ++i) {
    recorded_s.push_back(i);
    later_s.push_back(i + 7.5);
  }
  EXPECT_DOUBLE_EQ(curve_difference(recorded_s, recorded_s), 0);
  EXPECT_DOUBLE_EQ(curve_difference(recorded_s, later_s), 0.08) << "8 of 100 people";
  EXPECT_DOUBLE_EQ(curve_difference(later_s, recorded_s), 0.08);
  EXPECT_DOUBLE_EQ(curve_difference(recorded_s, {}), 1);
  EXPECT_DOUBLE_EQ(curve_difference({}, recorded_s), 0);
}

/// A trace of one person who is there in some steps, at x = step.
world::Trace walking_trace(const std::vector<bool>& present, double dt_s) {
  world::Trace trace;
  trace.header.dt_s = dt_s;
  trace.header.role = {world::AgentRole::person};
  for (std::size_t step = 0; step < present.size(); ++step) {
    trace.time_s.push_back(dt_s * static_cast<double>(step));
    trace.position.emplace_back(static_cast<float>(step), 0);
    trace.flags.push_back(present[step] ? world::kPresent : 0);
  }
  return trace;
}

TEST(RecordedWalks, BridgeShortGapsOnly) {
  std::vector<bool> present(40, true);
  for (std::size_t step = 5; step < 15; ++step) present[step] = false;  // 1 s
  Walks walks = recorded_walks(walking_trace(present, 0.1), {});
  ASSERT_EQ(walks.people.size(), 1U);
  ASSERT_EQ(walks.people[0].places.size(), 40U);
  EXPECT_NEAR(walks.people[0].places[9].x(), 9, 1e-6);
  present[15] = false;
  walks = recorded_walks(walking_trace(present, 0.1), {});
  ASSERT_EQ(walks.people.size(), 2U) << "who appears again later is another one";
  EXPECT_EQ(walks.people[0].places.size(), 5U);
  EXPECT_EQ(walks.people[1].first_step, 16U);
  EXPECT_EQ(walks.people[1].places.size(), 24U);
  EXPECT_NEAR(duration_s(walks), 3.9, 1e-9);
}

TEST(RecordedWalks, BelongToTheGoalThatTheyApproach) {
  // Seen from x = 0 to 9: still nearer to the goal behind, at -5, than to that ahead, at 30.
  const std::vector<Eigen::AlignedBox2d> goals = {{Vector2d(-6, -1), Vector2d(-5, 1)},
                                                  {Vector2d(30, -1), Vector2d(31, 1)}};
  const Walks walks = recorded_walks(walking_trace(std::vector<bool>(10, true), 0.1), goals);
  EXPECT_EQ(walks.people.at(0).stream, 1U);
}

TEST(RecordedWalks, BeginOnTheGround) {
  Recording recording = corridor();
  recording.obstacles = {{{0, 0}, {1, 0}, {1, 2}, {0, 2}}};
  Walks walks{
      0.1,
      {straight_walk({1, {-2, 1}, {1, 0}, 8}, 0.1), straight_walk({0, {0, 5}, {1, 0}, 8}, 0.1)}};
  begin_on_ground(walks, recording);
  ASSERT_EQ(walks.people.size(), 1U) << "the other one never comes there";
  EXPECT_NEAR(walks.people[0].places.front().x(), 1, 0.1001) << "behind the obstacle";
  EXPECT_EQ(walks.people[0].first_step + walks.people[0].places.size(), 91U) << "as late as before";
}

}  // namespace
}  // namespace throng::validation
