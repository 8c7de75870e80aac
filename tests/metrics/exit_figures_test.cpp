// Queue, pressure, Voronoi density, clogs and totals of an exit.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "metrics/density/pressure.h"
#include "metrics/exits/clogs.h"
#include "metrics/exits/exit_totals.h"
#include "metrics/exits/exits.h"
#include "metrics/exits/queue.h"
#include "tests/metrics/walks.h"

namespace throng::metrics {
namespace {

using Eigen::Vector2d;

ExitSeries walk_series(const std::vector<Walk>& walks, double duration_s = 60) {
  CrowdOfTest crowd;
  crowd.duration_s = duration_s;
  return exit_series(make_trace(walks, crowd), place_with_door(2)).at(0);
}

// A standing line of people straight back from the door, the first `first_m` from it.
std::vector<Walk> walk_in_line(int people, double first_m, double pitch_m) {
  std::vector<Walk> walks;
  for (int i = 0; i < people; ++i) walks.push_back(standing({-first_m - i * pitch_m, 0}));
  return walks;
}

TEST(ExitQueue, GoesAsFarAsTheLinksReach) {
  std::vector<Walk> walks = walk_in_line(8, 1, 1.1);
  walks.push_back(standing({-10, 0}));            // 1.3 m behind the last one
  walks.push_back(standing({0.3, 0}));            // beyond the door
  walks.push_back(walking({-2, 1}, {1, 0}, -9));  // fast enough not to queue
  const ExitSample sample = walk_series(walks).samples.front();
  EXPECT_EQ(sample.queue, 8);
  EXPECT_NEAR(sample.queue_length_m, 1 + 7 * 1.1, 1e-5);
  // Nothing was measured yet: the capacity of one lane, 0.8 m.
  EXPECT_NEAR(sample.predicted_wait_s, 8 / (1.3 * 0.8), 1e-9);
}

TEST(ExitQueue, OnlyThatPartOfTheDoorServesBeforeWhichPeopleStand) {
  CrowdOfTest crowd;
  std::vector<Walk> walks;
  for (int i = 0; i < 5; ++i) walks.push_back(standing({-1, i * 0.5 - 1.0}));
  const auto wait_s = [&](double door_m) {
    return exit_series(make_trace(walks, crowd), place_with_door(door_m))
        .at(0)
        .samples.front()
        .predicted_wait_s;
  };
  const double radius_m = make_trace(walks, crowd).header.radius_m.front();
  EXPECT_NEAR(wait_s(10), 5 / (1.3 * (2 + 2 * radius_m)), 1e-6);
  EXPECT_NEAR(wait_s(1.5), 5 / (1.3 * 1.5), 1e-6) << "never more than the door";
  EXPECT_NEAR(wait_s(0.5), 5 / (1.3 * 0.8), 1e-6) << "one lane passes whatever its width";
}

TEST(ExitQueue, AroundACornerIsAsLongAsTheWay) {
  std::vector<Walk> walks = walk_in_line(3, 1, 1);  // to x = -3
  for (int i = 1; i <= 4; ++i) walks.push_back(standing({-3, static_cast<double>(i)}));
  EXPECT_NEAR(walk_series(walks).samples.front().queue_length_m, 7, 1e-6);
}

TEST(ExitQueue, WhereNobodyStandsAtTheDoorThereIsNone) {
  const ExitSample sample = walk_series(walk_in_line(5, 4, 1)).samples.front();
  EXPECT_EQ(sample.queue, 0);
  EXPECT_EQ(sample.queue_length_m, 0);
  EXPECT_EQ(sample.predicted_wait_s, 0);
}

TEST(ExitQueue, TheWaitIsTheQueueOverTheFlow) {
  std::vector<Walk> walks = walk_in_line(6, 1, 1);
  // A person a second beside them, from 0.5 s on.
  for (int i = 0; i < 40; ++i) walks.push_back(walking({-0.55 - i, 0.9}, {1, 0}));
  const ExitSample sample = walk_series(walks).samples.at(300);
  EXPECT_EQ(sample.queue, 6);
  // 20 people in the last 20 s, and 10 s at the capacity of one lane, 1.04 /s.
  EXPECT_NEAR(sample.predicted_wait_s, 6 / ((20 + 10.4) / 30), 0.1);
}

TEST(ExitPressure, IsDensityTimesVariance) {
  // Alternate walkers at +1 and -1 m/s along y on a fine lattice: variance 1 about a mean of 0.
  std::vector<NearPerson> people;
  for (int row = -16; row < 16; ++row) {
    for (int column = -16; column < 16; ++column) {
      NearPerson person;
      person.place = {-1.5 + 0.25 * column, 0.25 * row};
      person.velocity = {0, (row + column) % 2 == 0 ? 1.0 : -1.0};
      people.push_back(person);
    }
  }
  const ControlZone zone(door(2), {});
  PressureMeter meter(zone, 0.1);
  double pressure = 0;
  for (int step = 0; step < 10; ++step) pressure = meter.step(people);
  EXPECT_NEAR(pressure, 16, 0.5) << "16 people per square metre";
  // It fades over one second.
  for (int step = 0; step < 5; ++step) pressure = meter.step({});
  EXPECT_NEAR(pressure, 8, 0.3);
  for (int step = 0; step < 5; ++step) pressure = meter.step({});
  EXPECT_NEAR(pressure, 0, 1e-9);
}

TEST(ExitPressure, IsZeroForAUniformStream) {
  const ExitSeries series = walk_series({walking({-5, 0}, {1, 0}), walking({-5, 1}, {1, 0})}, 8);
  for (const ExitSample& sample : series.samples) EXPECT_NEAR(sample.pressure_per_s2, 0, 1e-6);
}

TEST(ExitVoronoi, ALatticeHasItsDensity) {
  std::vector<Walk> walks;
  for (int row = -12; row <= 12; ++row) {
    for (int column = -16; column <= 8; ++column) {
      walks.push_back(standing({0.25 + 0.5 * column, 0.5 * row}));
    }
  }
  const ExitSample sample = walk_series(walks, 0.1).samples.front();
  EXPECT_NEAR(sample.voronoi_density_per_m2, 4, 1e-6);
  EXPECT_NEAR(sample.density_per_m2, 4, 0.5) << "counting whole people is rougher";
}

TEST(ExitFlow, SpecificFlowIsPerMeter) {
  std::vector<Walk> walks;
  for (int i = 0; i < 40; ++i) walks.push_back(walking({-0.55 - 0.5 * i, 0}, {1, 0}));
  const ExitSeries series = walk_series(walks, 15);
  for (const ExitSample& sample : series.samples) {
    EXPECT_DOUBLE_EQ(sample.specific_flow_per_ms, sample.flow_per_s / 2);
  }
  // Each is on the line at 0.55, 1.05, ... s, between two steps.
  ASSERT_GT(series.passages.size(), 25U);
  for (std::size_t i = 0; i < series.passages.size(); ++i) {
    EXPECT_NEAR(series.passages[i].time_s, 0.55 + 0.5 * static_cast<double>(i), 1e-5);
  }
}

// 49 people before the door; one leaves at 10.2 s, the next at 20.2 s.
std::vector<Walk> two_passers() {
  std::vector<Walk> walks;
  for (int row = 0; row < 7; ++row) {
    for (int column = -3; column <= 3; ++column) {
      walks.push_back(standing({-0.5 - 0.42 * row, 0.42 * column}));
    }
  }
  walks.push_back(walking({-0.2, 0}, {1, 0}, 10));
  walks.push_back(walking({-0.2, 0.1}, {1, 0}, 20));
  return walks;
}

TEST(ExitClogs, TheWholeGapIsClogged) {
  const ExitSeries series = walk_series(two_passers(), 30);
  ASSERT_EQ(series.clogs.size(), 3U);
  EXPECT_NEAR(series.clogs[0].from_s, 0, 1e-9);
  EXPECT_NEAR(series.clogs[0].until_s, 10.4, 0.101);
  EXPECT_NEAR(series.clogs[1].from_s, series.clogs[0].until_s, 1e-9);
  EXPECT_NEAR(series.clogs[1].until_s, 20.4, 0.101);
  EXPECT_TRUE(series.clogs[1].ended);
  EXPECT_FALSE(series.clogs[2].ended);
  EXPECT_NEAR(series.clogs[2].until_s, 30, 1e-9);
  EXPECT_GT(series.clogs[0].max_normalized_density, 0.35);
  EXPECT_EQ(series.clogs[0].members.size(), 44U) << "the last row stands 3.02 m away";
  for (const ExitSample& sample : series.samples) {
    EXPECT_EQ(sample.state_offline, ExitState::clogged);
  }
  EXPECT_EQ(series.samples[5].state, ExitState::congested) << "which nobody knew at the time";
}

TEST(ExitClogs, LastsUntilSomebodyPasses) {
  using enum ExitState;
  // A second per sample; crossings in samples 1 and 7, relief without any in 5 and 6.
  const std::vector<ExitState> states = {flowing, congested, congested, clogged,
                                         clogged, flowing,   flowing,   flowing};
  ExitSeries series;
  std::vector<double> time_s;
  for (std::size_t i = 0; i < states.size(); ++i) {
    ExitSample sample;
    sample.state = states[i];
    sample.demand = true;
    sample.since_crossing_s = i == 0 || i == 7 ? 0 : static_cast<double>(i) - 1;
    series.samples.push_back(sample);
    time_s.push_back(static_cast<double>(i));
  }
  ExitSeries left = series;
  find_clogs(series, time_s);
  ASSERT_EQ(series.clogs.size(), 1U);
  EXPECT_EQ(series.clogs[0].from_s, 1);
  EXPECT_EQ(series.clogs[0].until_s, 7);
  EXPECT_TRUE(series.clogs[0].ended);
  EXPECT_EQ(series.samples[6].state_offline, clogged);
  EXPECT_EQ(series.samples[7].state_offline, flowing);
  left.samples[6].demand = false;  // they have given up
  find_clogs(left, time_s);
  EXPECT_EQ(left.clogs.at(0).until_s, 6);
}

TEST(ExitClogs, AFreeDoorHasNone) {
  EXPECT_TRUE(walk_series({walking({-5, 0}, {1, 0})}).clogs.empty());
}

TEST(ExitTotals, AClosedDoorIsClosedAllTheTime) {
  world::Scenario scenario = place_with_door(2);
  scenario.exits[0].open = false;
  const world::Trace trace = make_trace(two_passers());
  const auto exits = exit_series(trace, scenario);
  for (const ExitSample& sample : exits[0].samples) EXPECT_EQ(sample.state, ExitState::closed);
  EXPECT_TRUE(exits[0].clogs.empty());
  const ExitTotals totals = exit_totals(exits, 0.1).at(0);
  EXPECT_NEAR(totals.state_s[4], 60.1, 1e-6);
  EXPECT_NEAR(totals.demand_s, 60.1, 1e-6);
  EXPECT_EQ(totals.clogging_index_s, 0);
  EXPECT_EQ(totals.capacity_per_s, 0);
}

TEST(ExitTotals, ADoorThatADisasterReachesIsClosedFromThenOn) {
  world::Scenario scenario = place_with_door(2);
  scenario.exits[0].closes_at_s = 20;
  const world::Trace trace = make_trace(two_passers());
  const auto exits = exit_series(trace, scenario);
  const auto& samples = exits[0].samples;
  for (std::size_t step = 0; step < samples.size(); ++step) {
    EXPECT_EQ(samples[step].state == ExitState::closed, step >= 200) << step;
    EXPECT_EQ(samples[step].state_offline == ExitState::closed, step >= 200) << step;
    EXPECT_TRUE(step < 200 || samples[step].clogging_index == 0) << step;
  }
  ASSERT_FALSE(exits[0].clogs.empty());
  EXPECT_LE(exits[0].clogs.back().until_s, 20 + 1e-9);
  EXPECT_TRUE(exits[0].clogs.back().ended);
  const ExitTotals totals = exit_totals(exits, 0.1).at(0);
  EXPECT_NEAR(totals.state_s[4], 40.1, 1e-6);
  EXPECT_NEAR(totals.capacity_per_s, 1.3 * 2 * 200 / 601, 1e-9) << "the mean over the run";
}

ExitTotals used(double capacity_per_s, int crossings, double share, double last_s) {
  ExitTotals totals;
  totals.capacity_per_s = capacity_per_s;
  totals.crossings.out = crossings;
  totals.share = share;
  totals.last_crossing_s = last_s;
  return totals;
}

TEST(ExitBalance, InProportionToCapacityIsPerfect) {
  const auto balance = balance_exits({used(1, 10, 0.25, 30), used(3, 30, 0.75, 44)});
  ASSERT_TRUE(balance);
  EXPECT_DOUBLE_EQ(balance->balance, 1);
  EXPECT_DOUBLE_EQ(balance->jain, 1);
  EXPECT_DOUBLE_EQ(balance->last_spread_s, 14);
}

TEST(ExitBalance, OneOfTwoEqualDoorsIsHalf) {
  ExitTotals unused = used(2, 0, 0, 0);
  unused.last_crossing_s.reset();
  const auto balance = balance_exits({used(2, 20, 1, 9), unused});
  ASSERT_TRUE(balance);
  EXPECT_DOUBLE_EQ(balance->balance, 0.5);
  EXPECT_DOUBLE_EQ(balance->jain, 0.5);
  EXPECT_DOUBLE_EQ(balance->last_spread_s, 0);
  EXPECT_FALSE(balance_exits({unused}));
}

TEST(ExitTotals, JsonNamesTheExits) {
  const world::Trace trace = make_trace(two_passers());
  const world::Scenario scenario = place_with_door(2);
  const auto totals = exit_totals(exit_series(trace, scenario), 0.1);
  const nlohmann::json json = to_json(totals.at(0));
  EXPECT_EQ(json.at("clogs").size(), 3U);
  EXPECT_EQ(json.at("clogs").at(0).at("members").size(), 44U);
  EXPECT_EQ(json.at("max_queue"), totals[0].max_queue);
  EXPECT_NEAR(json.at("gaps").at("median_s"), 10, 1e-3);
  EXPECT_EQ(json.at("gaps").at("list_s").size(), 1U);
  EXPECT_EQ(json.at("gaps").at("tail").at("valid"), false);
}

// One goes out, comes back and goes out again, another comes in and stays.
TEST(ExitCrossings, AreCountedInBothDirections) {
  const Walk to_and_fro = [](double time_s) -> Eigen::Vector2d {
    return {std::abs(std::fmod(time_s, 4) - 2) - 1, 0};
  };
  CrowdOfTest crowd;
  crowd.duration_s = 7.5;
  const world::Trace trace = make_trace({to_and_fro, walking({2, 0.5}, {-1, 0})}, crowd);
  // |x| falls from 1 at 0 s to -1 at 2 s and so on: in at 1 s, out at 3 s, in at 5 s, out at 7 s.
  const world::Scenario scenario = place_with_door(2);
  const auto totals = exit_totals(exit_series(trace, scenario), 0.1);
  EXPECT_EQ(totals[0].crossings.out, 2);
  EXPECT_EQ(totals[0].crossings.in, 3);
  EXPECT_EQ(totals[0].net_out(), -1);
  const nlohmann::json json = to_json(totals[0]);
  EXPECT_EQ(json.at("crossings").at("out"), 2);
  EXPECT_EQ(json.at("crossings").at("in"), 3);
  EXPECT_EQ(json.at("net_out"), -1);
}

}  // namespace
}  // namespace throng::metrics
