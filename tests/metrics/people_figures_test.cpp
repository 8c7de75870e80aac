// Notification, journeys, exposure, guidance and the lower bound of a run.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "base/error.h"
#include "base/geometry/point_grid.h"
#include "metrics/basis/walking_distance.h"
#include "metrics/density/ground_pressure.h"
#include "metrics/density/pressure.h"
#include "metrics/evacuation.h"
#include "tests/metrics/walks.h"

namespace throng::metrics {
namespace {

using Eigen::Vector2d;

/// With an alarm at the start where the scenario has none.
RunMetrics compute_figures(const world::Trace& trace,
                           world::Scenario scenario = place_with_door(2)) {
  if (scenario.disasters.empty()) add_alarm(scenario, 0);
  return run_metrics(trace, scenario, exit_series(trace, scenario));
}

// Person i starts `i` m before (8, 0), stands until `notice_s` and then walks out at 1 m/s.
world::Trace two_observers(double notice_s, double duration_s = 60) {
  CrowdOfTest crowd;
  crowd.duration_s = duration_s;
  world::Trace trace =
      make_trace({walking({-2, 0}, {1, 0}, notice_s), walking({-4, 0}, {1, 0}, notice_s)}, crowd);
  for (std::size_t step = 0; step < trace.steps(); ++step) {
    if (trace.time_s[step] >= notice_s) continue;
    for (const std::size_t agent : {0, 1}) trace.exit_intent[trace.at(step, agent)] = -1;
  }
  return trace;
}

TEST(NotificationFigures, CountFromTheFirstIntent) {
  const RunMetrics metrics = compute_figures(two_observers(5.05));
  EXPECT_EQ(metrics.notification->never, 0);
  ASSERT_TRUE(metrics.notification->first_s);
  EXPECT_NEAR(*metrics.notification->first_s, 5.1, 1e-6);
  EXPECT_NEAR(metrics.notification->times_s.back(), 5.1, 1e-6);
  // 12 and 14 m to x = 10, plus up to a step.
  const nlohmann::json after = to_json(*metrics.notification).at("escape_after_notice");
  EXPECT_NEAR(after.at("t50_s"), 12, 0.11);
  EXPECT_NEAR(after.at("t100_s"), 14, 0.11);
}

TEST(NotificationFigures, PeopleThatNeverNoticeAreCounted) {
  const RunMetrics metrics = compute_figures(two_observers(100));
  EXPECT_EQ(metrics.notification->never, 2);
  EXPECT_FALSE(metrics.notification->first_s);
  EXPECT_TRUE(to_json(metrics).at("notification").at("mean_s").is_null());
}

// Two notice, at 1 and 9 s, and need 12 s; a third never does. The run ends at 15 s.
TEST(NotificationFigures, PercentilesCountPeopleNotWatchedToTheEnd) {
  CrowdOfTest crowd;
  crowd.duration_s = 15;
  world::Trace trace = make_trace(
      {walking({-2, 0}, {1, 0}, 1), walking({-2, 1}, {1, 0}, 9), standing({-5, 0})}, crowd);
  for (std::size_t step = 0; step < trace.steps(); ++step) {
    if (step < 10) trace.exit_intent[trace.at(step, 0)] = -1;
    if (step < 90) trace.exit_intent[trace.at(step, 1)] = -1;
    trace.exit_intent[trace.at(step, 2)] = -1;
  }
  const nlohmann::json json = to_json(*compute_figures(trace).notification);
  EXPECT_EQ(json.at("noticed"), 2);
  EXPECT_EQ(json.at("never"), 1);
  EXPECT_NEAR(json.at("percentiles").at("t25_s"), 1, 1e-6) << "of all three";
  EXPECT_NEAR(json.at("percentiles").at("t50_s"), 9, 1e-6);
  EXPECT_TRUE(json.at("percentiles").at("t75_s").is_null());
  // The second was watched for 6 s only: by the first, everybody is out after 12 s.
  EXPECT_NEAR(json.at("escape_after_notice").at("t100_s"), 12, 0.11);
}

TEST(Horizons, AreKnownWhenEverybodyIsOut) {
  const RunMetrics metrics = compute_figures(two_observers(0));
  ASSERT_EQ(metrics.horizons.size(), 2U);
  EXPECT_EQ(metrics.horizons[0].not_escaped, 0);
  EXPECT_NEAR(*metrics.horizons[0].restricted_mean_s, 13, 0.11);
  const RunMetrics short_run = compute_figures(two_observers(0, 13));
  EXPECT_FALSE(short_run.horizons[0].not_escaped);
  EXPECT_NEAR(short_run.mean_escape_time_s, 12.5, 0.11);
}

TEST(Journeys, StraightToTheDoorHasNoDetour) {
  const RunMetrics metrics = compute_figures(two_observers(3));
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
  const RunMetrics metrics = compute_figures(make_trace({there_and_back}));
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
  EXPECT_NEAR(*distance.from({-10, 0}), 10, 1e-9);
  EXPECT_NEAR(*distance.from({-12, 10}), std::hypot(12, 9), 1e-9);
}

TEST(WalkingDistance, ThroughTwoCornersOfABuildingIsNoWay) {
  const WalkingDistance distance({{-20, -20}, {1, 20}}, {box({-6, -1}, {-4, 1})}, door(2));
  // The straight path to (0, 1) runs along the building's upper edge; that to (0, 0) through its
  // middle.
  EXPECT_NEAR(*distance.from({-10, 1}), 10, 0.2);
  EXPECT_GT(*distance.from({-10, 0}), 10.1);
}

TEST(WalkingDistance, IsKnownFromWhereTheDoorIsSeenThroughAGap) {
  const WalkingDistance distance({{-20, -20}, {1, 20}},
                                 {box({-6, -20}, {-5, -1}), box({-6, 1}, {-5, 20})}, door(2));
  EXPECT_NEAR(*distance.from({-15, 0.5}), 15, 1e-9);
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
  const Exposure exposure = compute_figures(make_trace(walks, crowd)).exposure;
  const int inner = 19 * 19;
  EXPECT_GE(exposure.above_person_s[1], inner - 1e-6);  // 3.57
  EXPECT_EQ(exposure.above_person_s[3], 0);             // 5
  EXPECT_EQ(exposure.above_person_s[4], 0);             // 5.55
  EXPECT_EQ(exposure.disc_packing_person_s[0], 0);      // 0.6
  EXPECT_GE(exposure.service_person_s[5], inner - 1e-6);
  double sum = 0;
  for (const double level : exposure.service_person_s) sum += level;
  EXPECT_NEAR(sum, 21 * 21, 1e-6);
  EXPECT_NEAR(exposure.max_density_per_m2, 4, 1e-6);
}

// Alternate walkers at +1 and -1 m/s on a fine lattice: 16 people per square meter, variance 1.
TEST(ExposureFigures, TheGreatestPressureIsDensityTimesVariance) {
  std::vector<Walk> walks;
  for (int row = -10; row < 10; ++row) {
    for (int column = -10; column < 10; ++column) {
      walks.push_back(standing({-8 + 0.25 * column, 0.25 * row}));
    }
  }
  CrowdOfTest crowd;
  crowd.duration_s = 2;
  world::Trace trace = make_trace(walks, crowd);
  for (std::size_t i = 0; i < trace.velocity.size(); ++i) {
    const auto agent = static_cast<int>(i % walks.size());
    trace.velocity[i] = {0, (agent / 20 + agent % 20) % 2 == 0 ? 1.0F : -1.0F};
  }
  EXPECT_NEAR(compute_figures(trace).exposure.max_pressure_per_s2, 16, 0.5);
  EXPECT_NEAR(to_json(compute_figures(trace)).at("exposure").at("max_pressure_per_s2"), 16, 0.5);
}

// For a second somebody stands still beside somebody who walks; then nobody is there.
TEST(ExposureFigures, ThePressureIsAMeanOverASecond) {
  const geometry::Region ground{{{-5, -5}, {5, 5}}};
  GroundPressure always(ground, {}, 0.1);
  GroundPressure half(ground, {}, 0.1);
  double most_always = 0;
  double most_half = 0;
  for (int step = 0; step < 30; ++step) {
    for (GroundPressure* pressure : {&always, &half}) {
      if (pressure == &half && step % 2 == 1) continue;
      pressure->add({0.25, 0.25}, {1, 0});
      pressure->add({0.25, 0.35}, {0, 0});
    }
    most_always = std::max(most_always, always.finish_step());
    const double now = half.finish_step();
    if (step > 10) most_half = std::max(most_half, now);
  }
  EXPECT_GT(most_always, 0.1);
  EXPECT_NEAR(most_half, 0.5 * most_always, 1e-9);
  // As it is at the place itself: two weights of almost 1, variance of a quarter.
  const std::vector<NearPerson> two = {{0, {0.25, 0.25}, {1, 0}, 1, true},
                                       {1, {0.25, 0.35}, {0, 0}, 1, true}};
  const std::vector<Vector2d> places = {two[0].place, two[1].place};
  EXPECT_NEAR(most_always, pressure_at({0.25, 0.25}, geometry::PointGrid(places, 1), two), 1e-9);
  GroundPressure covered(ground, std::vector<world::Building>{box({-5, -5}, {5, 5})}, 0.1);
  covered.add({0.25, 0.25}, {1, 0});
  covered.add({0.25, 0.35}, {0, 0});
  EXPECT_EQ(covered.finish_step(), 0);
}

TEST(ExposureFigures, ALonePersonIsAtTheBestLevel) {
  CrowdOfTest crowd;
  crowd.duration_s = 9.9;
  const Exposure exposure = compute_figures(make_trace({standing({-5, 0})}, crowd)).exposure;
  EXPECT_NEAR(exposure.service_person_s[0], 10, 1e-9);
  EXPECT_NEAR(exposure.max_density_per_m2, 1 / (std::numbers::pi * 4), 1e-6);
}

// A square lattice of so many people per m², of whom every other one walks at `mps` to and fro.
Exposure lattice_exposure(double pitch_m, float radius_m, float mps) {
  std::vector<Walk> walks;
  for (int row = 0; row < 15; ++row) {
    for (int column = 0; column < 15; ++column) {
      walks.push_back(standing({-15 + pitch_m * column, pitch_m * row}));
    }
  }
  CrowdOfTest crowd;
  crowd.duration_s = 0.9;  // ten steps: a second of everybody
  crowd.radius_m = radius_m;
  world::Trace trace = make_trace(walks, crowd);
  for (std::size_t i = 0; i < trace.velocity.size(); ++i) {
    const auto agent = i % walks.size();
    trace.velocity[i] = {0, (agent / 15 + agent % 15) % 2 == 0 ? mps : -mps};
  }
  return compute_figures(trace).exposure;
}

// 4 per m² is no crush, however large the discs are; 5.5 and 6.5 are, however small.
TEST(ExposureFigures, CrushIsAQuestionOfPeoplePerSquareMeter) {
  const double inner = 13 * 13;
  for (const float radius_m : {0.1F, 0.2F, 0.25F, 0.4F}) {
    const Exposure four = lattice_exposure(0.5, radius_m, 0);
    EXPECT_EQ(four.above_person_s[kCrushDensityIndex], 0) << radius_m;
    const Exposure above_five = lattice_exposure(1 / std::sqrt(5.5), radius_m, 0);
    EXPECT_GE(above_five.above_person_s[kCrushDensityIndex], inner - 1e-6) << radius_m;
    EXPECT_EQ(above_five.above_person_s.back(), 0) << radius_m;
    const Exposure above_six = lattice_exposure(1 / std::sqrt(6.5), radius_m, 0);
    EXPECT_GE(above_six.above_person_s.back(), inner - 1e-6) << radius_m;
  }
  // The discs' own figure is their packing density: 4 per m² of 1.8 possible ones.
  EXPECT_GT(lattice_exposure(0.5, 0.4F, 0).disc_packing_person_s[0], inner - 1e-6);
  EXPECT_EQ(lattice_exposure(0.5, 0.1F, 0).disc_packing_person_s[0], 0);
}

// Density 5.5, velocities of +v and -v: the pressure is 5.5 v² in the middle.
TEST(ExposureFigures, TurbulenceIsPressureInADenseCrowd) {
  const double pitch_m = 1 / std::sqrt(5.5);
  const auto speed_for = [](double pressure) {
    return static_cast<float>(std::sqrt(pressure / 5.5));
  };
  const Exposure calm = lattice_exposure(pitch_m, 0.2F, speed_for(0.015));
  EXPECT_EQ(calm.pressure_person_s[0], 0);
  EXPECT_EQ(calm.turbulent_5_person_s, 0);
  const Exposure onset = lattice_exposure(pitch_m, 0.2F, speed_for(0.03));
  EXPECT_GE(onset.pressure_person_s[0], 49 - 1e-6) << "the inner ones at least";
  EXPECT_EQ(onset.pressure_person_s[1], 0);
  EXPECT_GE(onset.turbulent_5_person_s, 49 - 1e-6);
  EXPECT_EQ(onset.turbulent_6_person_s, 0);
  const Exposure loose = lattice_exposure(0.6, 0.2F, 1);
  EXPECT_GT(loose.pressure_person_s[1], 49) << "fast, but nobody is pressed";
  EXPECT_EQ(loose.turbulent_5_person_s, 0);
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
  const Exposure exposure =
      compute_figures(make_trace({standing({-5, 0}), meeting}, crowd)).exposure;
  // Each owns half of a disc of 2 m and 0.1 m of the other's: less than 7 m² while they are near.
  const double alone = 1 / (std::numbers::pi * 4);
  EXPECT_LT(alone, kServiceDensities[0]);
  EXPECT_NEAR(exposure.service_person_s[0], 2 * 3.1, 1e-6) << "still level A";
  // The second's mean is over ten steps, half of them with both in the squares.
  EXPECT_GT(exposure.max_density_per_m2, 1.4 * alone);
  EXPECT_LT(exposure.max_density_per_m2, 2 * alone);
}

TEST(GuidanceFigures, FollowersAreInAStateOfThatName) {
  world::Trace trace = two_observers(0);
  trace.header.state_names = {"Walk", "FollowDrone"};
  for (std::size_t step = 10; step < 40; ++step) trace.state[trace.at(step, 1)] = 1;
  const GuidanceFigures guidance = compute_figures(trace).guidance;
  EXPECT_EQ(guidance.led, 1);
  EXPECT_NEAR(guidance.mean_followed_s, 3, 1e-9);
  EXPECT_NEAR(guidance.mean_followed_m, 3, 1e-4);
}

TEST(GuidanceFigures, TheEffectIsAgainstTheSameRunWithoutGuides) {
  const world::Scenario scenario = place_with_door(2);
  world::Trace led = two_observers(0);
  led.header.state_names = {"Walk", "FollowDrone"};
  led.state[led.at(3, 1)] = 1;  // one of the two
  const LeadEffect effect = lead_effect(led, two_observers(5), scenario);
  EXPECT_NEAR(effect.all_s, 10, 0.21);
  EXPECT_NEAR(effect.led_s, 5, 0.11);
  EXPECT_EQ(effect.censored, 0);
  EXPECT_NEAR(lead_effect(two_observers(5), two_observers(0), scenario).all_s, -10, 0.21);
  EXPECT_THROW(lead_effect(two_observers(5), led, scenario), InputError) << "drones lead there";
  // Both are out at 12 and 14 s; without guides nobody is when that run ends, at 10 s.
  const LeadEffect censored = lead_effect(two_observers(0), two_observers(5, 13), scenario);
  EXPECT_EQ(censored.censored, 2);
  EXPECT_NEAR(censored.all_s, 1, 0.11) << "one was out a second before the end of the shorter run";
  nlohmann::json json = to_json(GuidanceFigures{});
  add_to_json(effect, json);
  EXPECT_EQ(json.at("lead_efficiency_s"), effect.all_s);
  EXPECT_EQ(json.at("lead_efficiency_of_led_s"), effect.led_s);
}

TEST(GuidanceFigures, AnythingButThePairIsRefused) {
  const world::Scenario scenario = place_with_door(2);
  EXPECT_THROW(lead_effect(two_observers(0), make_trace({standing({0, 0})}), scenario), InputError);
  world::Trace other = two_observers(5);
  other.header.seed = 7;
  EXPECT_THROW(lead_effect(two_observers(0), other, scenario), InputError);
  other.header.seed = 0;
  other.header.scenario_id = "elsewhere";
  EXPECT_THROW(lead_effect(two_observers(0), other, scenario), InputError);
}

TEST(ReferenceTime, IsThatOfEachPersonsNoticeSpeedAndWay) {
  const RunMetrics metrics = compute_figures(two_observers(2));
  ASSERT_TRUE(metrics.reference);
  // 2 and 4 m to the door, in the second that ends 3.08 s after the notice at 2 s, and 10 m on at
  // 1.3 m/s.
  const double on_s = 10 / 1.3;
  ASSERT_EQ(metrics.reference->escape_s.size(), 2U);
  EXPECT_NEAR(metrics.reference->escape_s[0], 3 + on_s, 1e-6);
  EXPECT_NEAR(metrics.reference->escape_s[1], 5 + on_s, 1e-6);
  EXPECT_NEAR(metrics.reference->mean_s, 4 + on_s, 1e-6);
  const nlohmann::json json = to_json(metrics).at("reference_time");
  EXPECT_NEAR(json.at("t100_ratio"), 16 / (5 + on_s), 0.02);
  EXPECT_NEAR(json.at("mean_ratio"), 15 / (4 + on_s), 0.02);
}

TEST(ReferenceTime, GoesAroundBuildings) {
  const world::Trace trace = two_observers(0);
  world::Scenario walled = place_with_door(2);
  walled.buildings.push_back(box({-1.5, -6}, {-1, 6}));
  const double straight_s = compute_figures(trace).reference->escape_s.back();
  const double around_m = std::hypot(2.5, 6) + 0.5 + std::hypot(1, 5);  // to (0, 1)
  const double around_s = compute_figures(trace, walled).reference->escape_s.back();
  EXPECT_NEAR(around_s - straight_s, (around_m - 4) / 1.3, 1.1);
}

TEST(ReferenceTime, PeopleThatNeverNoticeNeverLeave) {
  world::Trace trace = make_trace({walking({-2, 0}, {1, 0}), standing({-5, 0})});
  for (std::size_t step = 0; step < trace.steps(); ++step) {
    trace.exit_intent[trace.at(step, 1)] = -1;
  }
  const RunMetrics metrics = compute_figures(trace);
  for (const char* name : {"lower_bound", "reference_time"}) {
    const nlohmann::json json = to_json(metrics).at(name);
    EXPECT_TRUE(json.at("t100_s").is_null());
    EXPECT_TRUE(json.at("t100_ratio").is_null());
    EXPECT_GE(json.at("t50_ratio"), 1.0);
    EXPECT_NEAR(json.at("mean_s"), (1 + 10 / 1.3 - 0 + 60) / 2, 0.6) << "counted to the run's end";
  }
}

TEST(PersonTable, HasARowForEverybody) {
  const RunMetrics metrics =
      compute_figures(make_trace({walking({-2, 0}, {1, 0}), standing({-5, 0})}));
  const nlohmann::json table = to_json(metrics).at("by_person");
  for (const auto& [name, column] : table.items()) EXPECT_EQ(column.size(), 2U) << name;
  EXPECT_EQ(table.at("exit"), (nlohmann::json{"door", nullptr}));
  EXPECT_NEAR(table.at("escaped_s").at(0), 12, 0.11);
  EXPECT_TRUE(table.at("escaped_s").at(1).is_null());
  EXPECT_NEAR(table.at("walked_m").at(0), 2, 0.11);
  EXPECT_NEAR(table.at("shortest_to_used_m").at(0), 2, 1e-6);
  EXPECT_EQ(table.at("stops"), (nlohmann::json{0, nullptr}));
}

}  // namespace
}  // namespace throng::metrics
