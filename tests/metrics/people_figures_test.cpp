// Notification, journeys, exposure, guidance and the lower bound of a run.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "base/error.h"
#include "metrics/evacuation.h"
#include "metrics/walking_distance.h"
#include "tests/metrics/walks.h"

namespace throng::metrics {
namespace {

using Eigen::Vector2d;

RunMetrics figures_of(const world::Trace& trace,
                      const world::Scenario& scenario = place_with_door(2)) {
  return run_metrics(trace, scenario, exit_series(trace, scenario));
}

// Person i starts `i` m before (8, 0), stands until `notice_s` and then walks out at 1 m/s.
world::Trace two_who_notice(double notice_s, double duration_s = 60) {
  CrowdOfTest crowd;
  crowd.duration_s = duration_s;
  world::Trace trace =
      trace_of({walking({-2, 0}, {1, 0}, notice_s), walking({-4, 0}, {1, 0}, notice_s)}, crowd);
  for (std::size_t step = 0; step < trace.steps(); ++step) {
    if (trace.time_s[step] >= notice_s) continue;
    for (const std::size_t agent : {0, 1}) trace.exit_intent[trace.at(step, agent)] = -1;
  }
  return trace;
}

TEST(NotificationFigures, CountFromTheFirstIntent) {
  const RunMetrics metrics = figures_of(two_who_notice(5.05));
  EXPECT_EQ(metrics.notification.never, 0);
  ASSERT_TRUE(metrics.notification.first_s);
  EXPECT_NEAR(*metrics.notification.first_s, 5.1, 1e-6);
  EXPECT_NEAR(metrics.notification.times_s.back(), 5.1, 1e-6);
  // 12 and 14 m to x = 10, plus up to a step.
  ASSERT_EQ(metrics.notification.escape_s.size(), 2U);
  EXPECT_NEAR(metrics.notification.escape_s[0], 12, 0.11);
  EXPECT_NEAR(metrics.notification.escape_s[1], 14, 0.11);
}

TEST(NotificationFigures, WhoNeverNoticesIsCounted) {
  const RunMetrics metrics = figures_of(two_who_notice(100));
  EXPECT_EQ(metrics.notification.never, 2);
  EXPECT_FALSE(metrics.notification.first_s);
  EXPECT_FALSE(metrics.bound);
  EXPECT_TRUE(to_json(metrics).at("notification").at("mean_s").is_null());
  EXPECT_TRUE(to_json(metrics).at("lower_bound").is_null());
}

TEST(Horizons, AreKnownWhenEverybodyIsOut) {
  const RunMetrics metrics = figures_of(two_who_notice(0));
  ASSERT_EQ(metrics.horizons.size(), 2U);
  EXPECT_EQ(metrics.horizons[0].not_escaped, 0);
  EXPECT_NEAR(*metrics.horizons[0].restricted_mean_s, 13, 0.11);
  const RunMetrics short_run = figures_of(two_who_notice(0, 13));
  EXPECT_FALSE(short_run.horizons[0].not_escaped);
  EXPECT_NEAR(short_run.mean_escape_time_s, 12.5, 0.11);
}

TEST(Journeys, StraightToTheDoorHasNoDetour) {
  const RunMetrics metrics = figures_of(two_who_notice(3));
  ASSERT_EQ(metrics.journeys.size(), 2U);
  EXPECT_NEAR(metrics.journeys[1].walked_m, 4, 0.11);
  EXPECT_NEAR(*metrics.journeys[1].to_used_m, 4, 0.02);
  EXPECT_NEAR(*metrics.journeys[1].to_nearest_m, 4, 0.02);
  EXPECT_NEAR(metrics.journeys[1].speed_ratio, 1 / 1.3, 0.03);
  EXPECT_EQ(metrics.journeys[1].stops, 0);
}

TEST(Journeys, AStopAndAnUnneededWayCount) {
  const Walk there_and_back = [](double time_s) -> Vector2d {
    if (time_s < 3) return {-4 - time_s, 0};
    if (time_s < 6) return {-7, 0};
    return {-7 + (time_s - 6), 0};
  };
  const RunMetrics metrics = figures_of(trace_of({there_and_back}));
  ASSERT_EQ(metrics.journeys.size(), 1U);
  EXPECT_NEAR(metrics.journeys[0].walked_m, 10, 0.11);
  EXPECT_EQ(metrics.journeys[0].stops, 1);
  const nlohmann::json json = to_json(metrics.journeys);
  EXPECT_NEAR(json.at("detour_to_used_exit").at("median"), 2.5, 0.05);
}

TEST(WalkingDistance, GoesAroundBuildings) {
  world::Exit exit = door(2);
  const world::Rectangle ground{{-20, -20}, {1, 20}};
  // A wall from y = -20 to y = 4 between the person and the door.
  const WalkingDistance distance(ground, {box({-6, -20}, {-5, 4})}, exit);
  const double to_corner = std::hypot(4, 4);  // from (-10, 0) to (-6, 4)
  const double past = 1 + std::hypot(5, 3);   // along the wall, then to (0, 1)
  ASSERT_TRUE(distance.from({-10, 0}));
  EXPECT_NEAR(*distance.from({-10, 0}), to_corner + past, 0.06 * (to_corner + past));
  EXPECT_FALSE(distance.from({-5.5, 0}));
  EXPECT_FALSE(distance.from({300, 0}));
}

TEST(WalkingDistance, IsStraightWhereTheGroundIsFree) {
  const WalkingDistance distance({{-20, -20}, {1, 20}}, {}, door(2));
  EXPECT_NEAR(*distance.from({-10, 0}), 10, 0.05);
  EXPECT_NEAR(*distance.from({-12, 10}), std::hypot(12, 9), 0.02 * 15);
}

// A lattice of 0.5 m: density 4, 0.554 of close packing for discs of 0.2 m, level F.
TEST(ExposureFigures, ALatticeIsAsDenseAsItIs) {
  std::vector<Walk> walks;
  for (int row = 0; row < 21; ++row) {
    for (int column = 0; column < 21; ++column) {
      walks.push_back(standing({-15 + 0.5 * column, -5 + 0.5 * row}));
    }
  }
  CrowdOfTest crowd;
  crowd.duration_s = 0.9;  // ten steps: a second of everybody
  const Exposure exposure = figures_of(trace_of(walks, crowd)).exposure;
  const int inner = 19 * 19;
  EXPECT_GE(exposure.above_person_s[1], inner - 1e-6);  // 3.57
  EXPECT_EQ(exposure.above_person_s[3], 0);             // 5.55
  EXPECT_EQ(exposure.packed_person_s[0], 0);            // 0.6
  EXPECT_GE(exposure.service_person_s[5], inner - 1e-6);
  double sum = 0;
  for (const double level : exposure.service_person_s) sum += level;
  EXPECT_NEAR(sum, 21 * 21, 1e-6);
  EXPECT_NEAR(exposure.max_density_per_m2, 4, 1e-6);
  EXPECT_EQ(exposure.crush_proxy_person_s, 0);
}

TEST(ExposureFigures, WhoIsAloneIsAtTheBestLevel) {
  CrowdOfTest crowd;
  crowd.duration_s = 9.9;
  const Exposure exposure = figures_of(trace_of({standing({-5, 0})}, crowd)).exposure;
  EXPECT_NEAR(exposure.service_person_s[0], 10, 1e-9);
  EXPECT_NEAR(exposure.max_density_per_m2, 1 / (std::numbers::pi * 4), 1e-6);
}

TEST(ExposureFigures, APackedCrowdThatStandsIsTheCrushProxy) {
  std::vector<Walk> walks;
  for (int row = 0; row < 9; ++row) {
    for (int column = 0; column < 9; ++column) {
      walks.push_back(standing({-15 + 0.37 * column, 0.37 * row}));
    }
  }
  CrowdOfTest crowd;
  crowd.duration_s = 0.4;  // half a second
  EXPECT_GE(figures_of(trace_of(walks, crowd)).exposure.crush_proxy_person_s, 0.5 * 7 * 7 - 1e-6);
}

// Two who pass at 0.5 m count at the steps at which they are near, not only at full seconds.
TEST(ExposureFigures, CountsEveryStep) {
  CrowdOfTest crowd;
  crowd.dt_s = 0.1;
  crowd.duration_s = 3;
  const auto meeting = [](double time_s) -> Eigen::Vector2d {
    const bool near = time_s > 1.25 && time_s < 1.75;  // five steps, between two full seconds
    return {near ? -5.1 : -9.0, 0};
  };
  const Exposure exposure = figures_of(trace_of({standing({-5, 0}), meeting}, crowd)).exposure;
  // Each owns half of a disc of 2 m and 0.1 m of the other's: less than 7 m² while they are near.
  const double alone = 1 / (std::numbers::pi * 4);
  EXPECT_LT(alone, kServiceDensities[0]);
  EXPECT_NEAR(exposure.service_person_s[0], 2 * 3.1, 1e-6) << "still level A";
  // The second's mean is over ten steps, half of them with both in the squares.
  EXPECT_GT(exposure.max_density_per_m2, 1.4 * alone);
  EXPECT_LT(exposure.max_density_per_m2, 2 * alone);
}

TEST(GuidanceFigures, FollowersAreInAStateOfThatName) {
  world::Trace trace = two_who_notice(0);
  trace.header.state_names = {"Walk", "FollowDrone"};
  for (std::size_t step = 10; step < 40; ++step) trace.state[trace.at(step, 1)] = 1;
  const GuidanceFigures guidance = figures_of(trace).guidance;
  EXPECT_EQ(guidance.led, 1);
  EXPECT_NEAR(guidance.mean_followed_s, 3, 1e-9);
  EXPECT_NEAR(guidance.mean_followed_m, 3, 1e-4);
}

TEST(GuidanceFigures, TheEffectIsAgainstTheSameRunWithoutGuides) {
  const world::Scenario scenario = place_with_door(2);
  EXPECT_NEAR(lead_efficiency_s(two_who_notice(0), two_who_notice(5), scenario), 10, 0.21);
  EXPECT_NEAR(lead_efficiency_s(two_who_notice(5), two_who_notice(0), scenario), -10, 0.21);
  const world::Trace other = trace_of({standing({0, 0})});
  EXPECT_THROW(lead_efficiency_s(two_who_notice(0), other, scenario), InputError);
}

TEST(LowerBoundOfARun, IsNotBeaten) {
  const RunMetrics metrics = figures_of(two_who_notice(2));
  ASSERT_TRUE(metrics.bound);
  // 4 m to the door and 10 m on, at 1.3 m/s.
  EXPECT_NEAR(metrics.bound->t100_s, 14 / 1.3, 1);
  EXPECT_GE(to_json(metrics).at("lower_bound").at("t100_ratio"), 1.0);
}

}  // namespace
}  // namespace throng::metrics
