// Measurements with people whose paths are known: model `dummy` walks as if alone, so times and
// speeds follow from lengths.
#include <gtest/gtest.h>

#include <cmath>

#include "validation/calm.h"
#include "validation/floors.h"
#include "validation/flow.h"
#include "validation/run.h"
#include "validation/suite.h"
#include "validation/walking.h"

namespace throng::validation {
namespace {

using Eigen::Vector2d;

const Tested kDummy{"dummy"};

/// A model that ignores walls and others and jumps aside by this deviation in each step.
Tested restless(double stddev_m) {
  return {"dummy", {describe::model("Dummy", {{"stddev", stddev_m}})}};
}

/// People at these places walk to the right at 1 m/s and leave at x = 10 m.
TestScene walk_right(const std::vector<Vector2d>& places) {
  TestScene scene;
  Group group;
  group.places = places;
  group.aside_m = 0;
  group.speed = Sampled::constant(1);
  scene.groups = {group};
  scene.behavior.goal_box(0, 10, -50, 12, 50)
      .add_state("Walk", {describe::select_goal("nearest", 0), describe::velocity("goal")});
  scene.behavior.leave_at_goal();
  return scene;
}

TEST(UntilAllLeft, ReturnsTheTimeOfTheLast) {
  crowd::Simulation crowd = load(walk_right({{0, 0}, {5, 1}, {8, -1}}), kDummy, 1);
  EXPECT_EQ(count_present(crowd), 3);
  int looks = 0;
  int present_at_4 = 0;
  const auto end = until_all_left(crowd, 100, [&](const crowd::Simulation& now) {
    ++looks;
    if (std::abs(now.time_s() - 4) < 1e-3) present_at_4 = static_cast<int>(count_present(now));
  });
  ASSERT_TRUE(end);
  EXPECT_NEAR(*end, 10, 0.5) << "10 m at 1 m/s";
  EXPECT_NEAR(looks, *end / 0.1, 1.01) << "once per step";
  EXPECT_EQ(present_at_4, 2);
  EXPECT_EQ(count_present(crowd), 0);
}

TEST(UntilAllLeft, StopsAtItsLimit) {
  crowd::Simulation crowd = load(walk_right({{0, 0}}), kDummy, 1);
  EXPECT_FALSE(until_all_left(crowd, 5));
  EXPECT_NEAR(crowd.time_s(), 5, 0.11);
}

TEST(UntilAllLeft, WaitsOneMinuteForTheNextAndTwoForTheFirst) {
  crowd::Simulation first = load(walk_right({{-100, 0}}), kDummy, 1);
  EXPECT_TRUE(until_all_left(first, 1000)) << "110 s until the first leaves";
  crowd::Simulation late = load(walk_right({{-115, 0}}), kDummy, 1);
  EXPECT_FALSE(until_all_left(late, 1000)) << "125 s";
  crowd::Simulation next = load(walk_right({{5, 0}, {-45, 0}}), kDummy, 1);
  EXPECT_TRUE(until_all_left(next, 1000)) << "50 s later";
  crowd::Simulation gap = load(walk_right({{5, 0}, {-60, 0}}), kDummy, 1);
  EXPECT_FALSE(until_all_left(gap, 1000)) << "65 s later";
}

TEST(WalkCorridor, TakesLengthOverSpeed) {
  EXPECT_NEAR(walk_corridor(kDummy, 1).time_s, 40, 0.5);
  EXPECT_NEAR(walk_corridor(kDummy, 1.6).time_s, 25, 0.5);
  EXPECT_TRUE(walk_corridor(kDummy, 1).inside);
  EXPECT_FALSE(walk_corridor(restless(0.5), 1).inside) << "jumps through walls";
  EXPECT_EQ(walk_corridor(kDummy, 0.1).time_s, 0) << "does not arrive";
}

TEST(WalkAlone, MeasuresFreeSpeeds) {
  const std::vector<double> speeds = walk_alone(kDummy, Sampled::constant(1.1), 7);
  ASSERT_EQ(speeds.size(), 7);
  for (const double speed : speeds) EXPECT_NEAR(speed, 1.1, 1e-3);
  for (const double speed : walk_alone(kDummy, Sampled::uniform(0.5, 0.6), 30)) {
    EXPECT_GE(speed, 0.499);
    EXPECT_LE(speed, 0.601);
  }
}

TEST(ExitsUsed, CountsByTheNearestExit) {
  TestScene scene = walk_right({{0, 0}, {0, 1}, {0, 20}});
  crowd::Simulation crowd = load(scene, kDummy, 1);
  EXPECT_EQ(exits_used(crowd, {Vector2d(10, 20), Vector2d(10, 0), Vector2d(0, 0)}, 60),
            (std::vector<int>{1, 2, 0}));
  crowd::Simulation stopped = load(scene, kDummy, 1);
  EXPECT_EQ(exits_used(stopped, {Vector2d(10, 20), Vector2d(10, 0)}, 3), (std::vector<int>{0, 0}));
}

TEST(CentralRate, IsTheSlopeBetweenTwoPercentiles) {
  std::vector<double> times;
  for (int i = 1; i <= 100; ++i) times.push_back(0.5 * i);
  EXPECT_DOUBLE_EQ(central_rate(times, 100), 2) << "one each half second";
  times.resize(80);
  EXPECT_DOUBLE_EQ(central_rate(times, 100), 2) << "the last fifth is not needed";
  times.resize(79);
  EXPECT_EQ(central_rate(times, 100), 0);
  EXPECT_EQ(central_rate({1, 2, 3}, 3), 0) << "too few for a percentile";
  // 20 people: from the 2nd to the 16th, 14 people; the slow ends do not count.
  std::vector<double> ends = {0,   100, 101, 102, 103, 104, 105, 106, 107, 108,
                              109, 110, 111, 112, 113, 114, 500, 600, 700, 800};
  EXPECT_DOUBLE_EQ(central_rate(ends, 20), 1);
}

TEST(RingSpeed, IsTheFreeSpeedOfPeopleAlone) {
  Ring spec;
  spec.people = 10;
  spec.speed = Sampled::constant(0.8);
  crowd::Simulation crowd = load(ring(spec), kDummy, 1);
  EXPECT_NEAR(mean_ring_speed(crowd, 5, 15), 0.8, 0.02);
  const DensitySpeed measured = walk_in_ring(kDummy, 0.3, 1);
  EXPECT_EQ(measured.density, 0.3);
  EXPECT_NEAR(measured.speed_mps, 1.34, 0.1) << "71 people of Weidmann's free speeds";
}

TEST(WeidmannSpeed, FallsAndIsNeverNegative) {
  double last = 2;
  for (double density = 0.1; density < 7; density += 0.1) {
    const double speed = weidmann_speed_mps(density);
    EXPECT_LE(speed, last);
    EXPECT_GE(speed, 0);
    last = speed;
  }
  // Computed by hand: 1.34 (1 - exp(-1.913 (1 / density - 1 / 5.4))).
  EXPECT_NEAR(weidmann_speed_mps(0.5), 1.30, 0.01);
  EXPECT_NEAR(weidmann_speed_mps(2), 0.61, 0.01);
  EXPECT_NEAR(weidmann_speed_mps(3), 0.33, 0.01);
  EXPECT_NEAR(weidmann_speed_mps(4), 0.16, 0.01);
}

TEST(LeaveRoom, MeasuresFlowAndOverlap) {
  const ExitRun run = leave_room(kDummy, 1);
  EXPECT_TRUE(run.all_out);
  // The last is a slow person from the far wall: 8 m at 0.58 to 1 m/s, 100 people.
  EXPECT_GT(run.flow_per_s, 100 / (8 / 0.58 + 1));
  EXPECT_LT(run.flow_per_s, 100 / (7.7 / 2.1));
  EXPECT_GT(run.overlap_m, 0.2) << "nobody minds anybody";
  EXPECT_LE(run.overlap_m, 0.4 + 1e-6) << "two radii";
}

TEST(CrossSquare, FindsNoLoneWalkerStuck) {
  const SquareRun run = cross_square(kDummy, 0.1, 1);
  EXPECT_LE(run.stuck, 0.05);
  EXPECT_NEAR(run.speed_mps, 1.34, 0.1);
  EXPECT_GT(run.acceleration_mps2, 0) << "they turn at goals";
}

TEST(PassCorridor, EndsWhenTheLastIsAcross) {
  const CounterRun run = pass_corridor(kDummy, 30, 1);
  EXPECT_EQ(run.left, 0);
  // From x = -9.5 to 17 at 0.58 m/s is 46 s; at the default mean of 1.34 m/s, 13 to 20 s.
  EXPECT_GT(run.time_s, 15);
  EXPECT_LT(run.time_s, 60);
}

TEST(WalkBothWays, FindsTheRateOfArrivals) {
  const TwoWayRun run = walk_both_ways(kDummy, 0.5, 1);
  // 240 arrivals in 120 s, sqrt(240) / 480 = 0.03 of a Poisson process; four deviations.
  EXPECT_NEAR(run.there, 0.5, 0.13);
  EXPECT_NEAR(run.back, 0.5, 0.13);
  EXPECT_NE(run.there, run.back) << "two streams of random numbers";
}

TEST(CorridorFlow, DividesByTheWidth) {
  // 160 people on 39.5 m who walk at 1.34 m/s on average: about 160 / 39.5 * 1.34 / 2 per meter.
  const double flow = corridor_flow(kDummy, {2, Turn::none}, 1);
  EXPECT_NEAR(flow, 2.7, 0.7);
  EXPECT_NEAR(corridor_flow(kDummy, {4, Turn::none}, 1), flow, 0.5)
      << "twice as many, twice as wide";
  EXPECT_GT(corridor_flow(kDummy, {2, Turn::block}, 1), 0.5 * flow);
  EXPECT_NEAR(corridor_flow(kDummy, {2, Turn::thin}, 1), corridor_flow(kDummy, {2, Turn::block}, 1),
              0.1 * flow);
  EXPECT_NEAR(corridor_flow(kDummy, {2, Turn::none, true}, 1), 1.5 * flow, 0.5)
      << "three instead of two per square meter";
}

TEST(Meet, FindsWhetherTwoBodiesTouch) {
  const MeetingRun far = meet(kDummy, 0.45, 1);
  EXPECT_TRUE(far.passed) << "0.45 m apart, radii of 0.17 m";
  EXPECT_EQ(far.begins_s, 0) << "nobody goes aside";
  EXPECT_NEAR(far.acceleration_mps2, 0, 0.01);
  EXPECT_FALSE(meet(kDummy, 0.3, 1).passed);
  const MeetingRun evading = meet({"orca"}, 0.05, 1);
  EXPECT_TRUE(evading.passed);
  EXPECT_GT(evading.begins_s, 0);
  EXPECT_GT(evading.acceleration_mps2, 0);
}

TEST(StandInQueue, CountsPassagesAndTurns) {
  const QueueRun empty = stand_in_queue(kDummy, 1);
  EXPECT_EQ(empty.passed, 150) << "a minute is enough for everybody";
  EXPECT_EQ(empty.turns, 0) << "nobody is left to turn";
  EXPECT_EQ(empty.stops, 0);
  const QueueRun slow = stand_in_queue({"weidmann"}, 1);
  // 1.2 to 1.7 people per meter and second, who turn calmly, but stop often.
  EXPECT_GT(slow.passed, 40U);
  EXPECT_LT(slow.passed, 120U);
  EXPECT_GT(slow.stops, 5);
}

TEST(SpecificFlow, FollowsTheSeedOnly) {
  const Bottleneck door = {1, 0.2, 40};
  const double flow = specific_flow({"weidmann"}, door, 3);
  EXPECT_EQ(flow, specific_flow({"weidmann"}, door, 3));
  EXPECT_NE(flow, specific_flow({"weidmann"}, door, 4));
  EXPECT_GT(specific_flow(kDummy, door, 3), flow) << "without others in the path";
}

/// People who walk as if alone meet criteria of single persons only.
class Alone : public testing::TestWithParam<std::pair<const char*, bool>> {};

TEST_P(Alone, PassesTestsOfSinglePersonsOnly) {
  const auto& [id, passes] = GetParam();
  const Verdict verdict =
      run_suite(chosen_models({"dummy"}), {id}, Effort::reduced, 1).verdicts[0][0];
  EXPECT_EQ(verdict.passed, passes) << verdict.measured;
}

INSTANTIATE_TEST_SUITE_P(Suite, Alone,
                         testing::Values(std::pair("rimea_1", true), std::pair("rimea_5", true),
                                         std::pair("rimea_7", true), std::pair("nist_2_1", true),
                                         std::pair("nist_2_4", true), std::pair("rimea_10", true),
                                         std::pair("weidmann", false), std::pair("doors", false),
                                         std::pair("rimea_9", false), std::pair("rimea_16", false),
                                         std::pair("capacity_drop", false),
                                         std::pair("imo_4", false), std::pair("evasion", false),
                                         std::pair("rimea_12d", false)),
                         [](const auto& tested) { return std::string(tested.param.first); });

TEST(Watch, FindsOverlapsAndCalmWalkers) {
  const CalmRun run = watch(kDummy, WatchedScene::counter_flow, 1);
  EXPECT_GT(run.overlap_m, 0.2) << "nobody minds anybody";
  EXPECT_LE(run.overlap_m, 2 * crowd::kAdultRadiusM + 1e-6);
  EXPECT_LT(run.turns, 0.5) << "they walk straight on";
  EXPECT_EQ(run.slow_yaw_rate_deg_s, 0) << "nobody slows down";
  const CalmRun queue = watch({"orca"}, WatchedScene::queue, 1);
  EXPECT_GT(queue.slow_yaw_rate_deg_s, 0) << "people wait, and turn a little";
  EXPECT_LT(queue.overlap_m, run.overlap_m);
}

}  // namespace
}  // namespace throng::validation
