#include "metrics/exits/exits.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "base/error.h"
#include "tests/metrics/walks.h"

namespace throng::metrics {
namespace {

using Eigen::Vector2d;

ExitSeries observe(const world::Trace& trace, double width_m = 2) {
  return exit_series(trace, place_with_door(width_m)).at(0);
}

// People who follow each other at 1 m/s, `gap_s` apart; the first reaches the line at `first_s`.
std::vector<Walk> column(int people, double gap_s, double first_s) {
  std::vector<Walk> walks;
  walks.reserve(people);
  for (int i = 0; i < people; ++i) walks.push_back(walking({-first_s - i * gap_s, 0}, {1, 0}));
  return walks;
}

// People on a square lattice, row behind row, whose front row is 0.5 m before the door.
std::vector<Vector2d> block(int rows, int columns, double pitch_m) {
  std::vector<Vector2d> places;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      places.emplace_back(-0.5 - row * pitch_m, (column - 0.5 * (columns - 1)) * pitch_m);
    }
  }
  return places;
}

TEST(ExitSeries, AnEvenStreamHasItsFlow) {
  const ExitSeries series = observe(make_trace(column(40, 0.5, 3.05)));
  EXPECT_EQ(series.exit_id, "door");
  EXPECT_DOUBLE_EQ(series.width_m, 2);
  ASSERT_EQ(series.samples.size(), 601U);
  EXPECT_EQ(series.samples.front().net_out(), 0);
  EXPECT_EQ(series.samples.back().net_out(), 40);
  for (int step = 100; step <= 200; ++step) {
    EXPECT_NEAR(series.samples[step].flow_per_s, 2.0, 0.26) << step;
    EXPECT_LE(series.samples[step].since_crossing_s, 0.51) << step;
  }
  EXPECT_DOUBLE_EQ(series.samples[150].flow_per_s,
                   (series.samples[150].net_out() - series.samples[110].net_out()) / 4.0);
  // The last one, at 22.55 s, counts when 0.2 m beyond the line, at the step after that.
  EXPECT_NEAR(series.samples.back().since_crossing_s, 60 - 22.8, 1e-6);
  EXPECT_DOUBLE_EQ(series.samples.back().flow_per_s, 0);
}

// A column 0.5 m apart at 1 m/s: two a second on any line, six on the 3 m of it in the zone.
// Exactly.
TEST(ExitSeries, AUniformColumnHasItsFlowDensityAndEdieFigures) {
  CrowdOfTest crowd;
  crowd.duration_s = 20;
  const world::Trace trace = make_trace(column(60, 0.5, 0.05), crowd);
  const ExitSeries series = observe(trace);
  const double area = std::numbers::pi * 9 / 2;
  for (int step = 45; step <= 200; ++step) {
    const ExitSample& sample = series.samples[step];
    EXPECT_DOUBLE_EQ(sample.flow_per_s, 2) << step;
    EXPECT_DOUBLE_EQ(sample.specific_flow_per_ms, 1) << step;
    EXPECT_EQ(sample.in_zone, 6) << step;
    EXPECT_NEAR(sample.density_per_m2, 6 / area, 1e-6) << step;
    EXPECT_TRUE(sample.demand);
  }
  EXPECT_NEAR(series.edie.duration_s(), 20, 1e-6);
  EXPECT_NEAR(series.edie.density_per_m2(), 6 / area, 1e-5);
  EXPECT_NEAR(series.edie.flow_per_ms(), 6 / area, 1e-5);
  EXPECT_NEAR(series.edie.speed_mps(), 1, 1e-5);
}

// Lanes at 0.8 and 1.6 m/s: flow is density times speed of each, and the mean speed that over all.
TEST(ExitSeries, EdieWeighsSpeedsByTimeInTheZone) {
  std::vector<Walk> walks;
  for (int i = 0; i < 120; ++i) {
    walks.push_back(walking({-0.04 - 0.4 * i, 0.5}, {0.8, 0}));
    walks.push_back(walking({-0.04 - 0.8 * i, -0.5}, {1.6, 0}));
  }
  CrowdOfTest crowd;
  crowd.duration_s = 15;
  const EdieRegion edie = observe(make_trace(walks, crowd)).edie;
  const double area = std::numbers::pi * 9 / 2;
  const double lane = std::sqrt(9 - 0.25);
  EXPECT_NEAR(edie.density_per_m2(), (lane / 0.4 + lane / 0.8) / area, 1e-4);
  EXPECT_NEAR(edie.flow_per_ms(), (lane / 0.4 * 0.8 + lane / 0.8 * 1.6) / area, 1e-4);
  EXPECT_NEAR(edie.speed_mps(), (0.8 / 0.4 + 1.6 / 0.8) / (1 / 0.4 + 1 / 0.8), 1e-4);
}

TEST(ExitSeries, IsCausal) {
  const auto walks = column(20, 0.7, 2);
  CrowdOfTest half;
  half.duration_s = 9;
  const auto all = observe(make_trace(walks)).samples;
  const auto first = observe(make_trace(walks, half)).samples;
  for (std::size_t step = 0; step < first.size(); ++step) {
    EXPECT_EQ(first[step].net_out(), all[step].net_out());
    EXPECT_EQ(first[step].state, all[step].state);
    EXPECT_EQ(first[step].clogging_index, all[step].clogging_index);
  }
}

TEST(ExitSeries, ReturningPeopleAreSubtractedAndPassersbyNotCounted) {
  std::vector<Walk> walks = column(3, 1, 2);
  walks.push_back(walking({10, 0}, {-1, 0}));
  walks.push_back(walking({-5, 4}, {1, 0}));
  const auto samples = observe(make_trace(walks)).samples;
  EXPECT_EQ(samples[90].net_out(), 3);
  EXPECT_EQ(samples.back().net_out(), 2);
  // Coming in is no outward crossing: the last was at 4 s and counted at 4.2 s.
  EXPECT_NEAR(samples.back().since_crossing_s, 60 - 4.2, 0.11);
}

TEST(ExitSeries, MeasuresTheZone) {
  // 9 people at 0.5 m spacing, all moving straight at the door's middle at 0.4 m/s.
  std::vector<Walk> walks;
  for (const Vector2d& place : block(3, 3, 0.5)) {
    walks.push_back(walking(place, -0.4 * place.normalized()));
  }
  walks.push_back(standing({-10, 0}));
  walks.push_back(standing({0.5, 0}));
  const ExitSeries series = observe(make_trace(walks));
  const ExitSample& sample = series.samples.front();
  const double area = std::numbers::pi * 9 / 2;
  EXPECT_NEAR(series.zone_area_m2, area, 1e-6);
  EXPECT_EQ(sample.in_zone, 9);
  EXPECT_NEAR(sample.density_per_m2, 9 / area, 1e-6);
  EXPECT_NEAR(sample.normalized_density, 9 / area * 2 * std::sqrt(3.0) * 0.04, 1e-6);
  EXPECT_NEAR(sample.approach_speed_mps, 0.4, 1e-4);
}

TEST(ExitSeries, CountsOnlyPeopleThatIntendTheExit) {
  const std::vector<Walk> walks = {standing({-1, 0}), standing({-1, 0.5}), standing({-1, 1})};
  world::Trace trace = make_trace(walks);
  for (std::size_t step = 0; step < trace.steps(); ++step)
    trace.exit_intent[trace.at(step, 1)] = -1;
  trace.header.role[2] = world::AgentRole::disaster;
  EXPECT_EQ(observe(trace).samples.front().in_zone, 1);

  // Without recorded intents everybody in the zone counts.
  trace.header.exit_ids.clear();
  EXPECT_EQ(observe(trace).samples.front().in_zone, 2);
}

TEST(ExitSeries, IntentsAreFoundByIdNotByIndex) {
  const std::vector<Walk> walks = {standing({-1, 0})};
  EXPECT_EQ(observe(make_trace(walks, {}, {"other", "door"})).samples.front().in_zone, 0);
  EXPECT_EQ(observe(make_trace(walks, {}, {"door", "other"})).samples.front().in_zone, 1);
}

TEST(ExitSeries, NobodyIsIdleForEver) {
  for (const ExitSample& sample : observe(make_trace({})).samples) {
    EXPECT_EQ(sample.state, ExitState::idle);
    EXPECT_EQ(sample.in_zone, 0);
    EXPECT_EQ(sample.clogging_index, 0);
    EXPECT_TRUE(std::isfinite(sample.normalized_density));
  }
}

// A dense crowd goes through the door, is stopped after three of its nine rows, and goes on.
TEST(ExitSeries, ACrowdThatStopsFlowsCongestsClogsAndRecovers) {
  const double stop_s = 10;
  const double go_s = 20;
  std::vector<Walk> walks;
  for (const Vector2d& place : block(9, 7, 0.38)) {
    walks.emplace_back([=](double time_s) -> Vector2d {
      const double walked_s = std::min(time_s, stop_s) - stop_s + std::max(0.0, time_s - go_s);
      return place + Vector2d(1.5 + walked_s, 0);
    });
  }
  const auto samples = observe(make_trace(walks)).samples;
  const auto at = [&](double time_s) { return samples[std::lround(time_s * 10)]; };

  EXPECT_EQ(at(0).state, ExitState::idle);
  EXPECT_EQ(at(9.9).state, ExitState::flowing);
  EXPECT_EQ(at(10).net_out(), 21);
  EXPECT_EQ(at(10.1).state, ExitState::congested);
  EXPECT_EQ(at(11.9).state, ExitState::congested);
  EXPECT_EQ(at(12).state, ExitState::clogged);
  EXPECT_EQ(at(20.3).state, ExitState::clogged);
  EXPECT_EQ(at(20.4).state, ExitState::congested) << "the fourth row is through";
  EXPECT_EQ(at(20.9).state, ExitState::congested);
  EXPECT_EQ(at(21).state, ExitState::flowing) << "one second at 0.77 of the desired speed";
  EXPECT_EQ(samples.back().state, ExitState::idle);
  EXPECT_EQ(samples.back().net_out(), 63);

  // Standing: no flow, no speed, so only the density limits the index.
  EXPECT_NEAR(at(16).clogging_index, at(16).normalized_density / 0.6, 1e-6);
  EXPECT_GT(at(16).clogging_index, 0.5);
  for (const ExitSample& sample : samples) {
    const double flow_lack = std::max(0.0, 1 - sample.flow_per_s / (1.3 * 2));
    const double speed_lack = std::max(0.0, 1 - sample.approach_speed_mps / (0.6 * 1.3));
    const double expected =
        std::min(1.0, sample.normalized_density / 0.6) * (0.5 * flow_lack + 0.5 * speed_lack);
    EXPECT_NEAR(sample.clogging_index, sample.state == ExitState::idle ? 0 : expected, 1e-6);
  }
}

// A person who finds the door blocked did not wait before arriving.
TEST(ExitSeries, TheGapStartsWithTheDemand) {
  std::vector<Walk> walks;
  for (const Vector2d& place : block(7, 7, 0.42)) {
    walks.emplace_back(
        [=](double time_s) -> Vector2d { return place - Vector2d(time_s < 30 ? 10 : 0, 0); });
  }
  const auto samples = observe(make_trace(walks)).samples;
  EXPECT_EQ(samples[299].state, ExitState::idle);
  EXPECT_EQ(samples[319].state, ExitState::congested);
  EXPECT_EQ(samples[320].state, ExitState::clogged);
}

// A standing crowd from the first step on: the gap is measured from the start.
TEST(ExitSeries, AStandingCrowdClogsAfterTheClogTime) {
  std::vector<Walk> walks;
  for (const Vector2d& place : block(7, 7, 0.42)) walks.push_back(standing(place));
  const auto wide = observe(make_trace(walks)).samples;
  EXPECT_EQ(wide[0].state, ExitState::congested);
  EXPECT_EQ(wide[19].state, ExitState::congested);
  EXPECT_EQ(wide[20].state, ExitState::clogged);
  // A door of 1 m takes 1.3 people/s: three of them are 2.31 s.
  const auto narrow = observe(make_trace(walks), 1).samples;
  EXPECT_EQ(narrow[23].state, ExitState::congested);
  EXPECT_EQ(narrow[24].state, ExitState::clogged);
}

// One person gets through a clog: congested again until the gap is long enough once more.
TEST(ExitSeries, AnOutwardCrossingEndsAClog) {
  std::vector<Walk> walks;
  for (const Vector2d& place : block(7, 7, 0.42)) walks.push_back(standing(place));
  walks.push_back(walking({-0.2, 0}, {1, 0}, 10));
  const auto samples = observe(make_trace(walks)).samples;
  EXPECT_EQ(samples[100].state, ExitState::clogged);
  EXPECT_EQ(samples[106].state, ExitState::congested);
  EXPECT_EQ(samples[106].net_out(), 1);
  EXPECT_EQ(samples[122].state, ExitState::congested);
  EXPECT_EQ(samples[126].state, ExitState::clogged);
}

// Speed that comes and goes within a second does not end a jam.
TEST(ExitSeries, AShortReliefDoesNotEndAJam) {
  std::vector<Walk> walks;
  for (const Vector2d& place : block(7, 7, 0.42)) {
    walks.emplace_back([place](double time_s) -> Vector2d {
      const double moved = std::clamp(time_s - 1, 0.0, 0.4);
      return place + Vector2d(0.9 * moved, 0);
    });
  }
  const auto samples = observe(make_trace(walks)).samples;
  EXPECT_GT(samples[12].approach_speed_mps, 0.4 * 1.3);
  for (int step = 0; step < 19; ++step) {
    EXPECT_EQ(samples[step].state, ExitState::congested) << step;
  }
}

TEST(ExitSeries, AnExitThatCannotWorkIsTheUsersError) {
  const world::Trace trace = make_trace({standing({-1, 0})});
  world::Scenario walled = place_with_door(2);
  walled.buildings.push_back(box({-30, -30}, {0, 30}));
  world::Scenario point = place_with_door(0);
  for (const world::Scenario& scenario : {walled, point}) {
    try {
      exit_series(trace, scenario);
      FAIL() << "no error";
    } catch (const InputError& error) {
      EXPECT_EQ(error.problems().at(0).where, "/exits/0");
    }
  }
}

}  // namespace
}  // namespace throng::metrics
