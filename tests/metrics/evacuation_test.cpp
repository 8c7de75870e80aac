#include "metrics/evacuation.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <vector>

#include "tests/metrics/walks.h"

namespace throng::metrics {
namespace {

RunMetrics measure(const world::Trace& trace,
                   const world::Scenario& scenario = place_with_door_at_border(2)) {
  return run_metrics(trace, scenario, exit_series(trace, scenario));
}

// Person i of n leaves the scenario (x > 10) at about i + 1 s.
world::Trace one_a_second(int people, double duration_s) {
  std::vector<Walk> walks;
  walks.reserve(people);
  for (int i = 0; i < people; ++i) walks.push_back(walking({9.05 - i, 0}, {1, 0}));
  CrowdOfTest crowd;
  crowd.duration_s = duration_s;
  return make_trace(walks, crowd);
}

TEST(RunMetrics, StraightWalkersGiveAStraightEscapeCurve) {
  const RunMetrics metrics = measure(one_a_second(20, 30));
  EXPECT_EQ(metrics.people, 20);
  EXPECT_EQ(metrics.not_escaped, 0);
  EXPECT_DOUBLE_EQ(metrics.duration_s, 30);
  ASSERT_EQ(metrics.escape_curve.size(), 31U);
  for (int second = 0; second <= 30; ++second) {
    EXPECT_DOUBLE_EQ(metrics.escape_curve[second], std::min(second, 20) / 20.0) << second;
  }
  for (const RunMetrics::Percentile& percentile : metrics.percentiles) {
    ASSERT_TRUE(percentile.time_s) << percentile.percent;
    EXPECT_NEAR(*percentile.time_s, std::ceil(percentile.percent * 0.2), 0.051);
  }
  EXPECT_NEAR(metrics.mean_escape_time_s, 10.5, 0.051);
}

TEST(RunMetrics, PeopleStillInsideCountUntilTheEnd) {
  const RunMetrics metrics = measure(one_a_second(20, 10.5));
  EXPECT_EQ(metrics.not_escaped, 10);
  EXPECT_EQ(metrics.escape_curve.size(), 11U);
  EXPECT_DOUBLE_EQ(metrics.escape_curve.back(), 0.5);
  ASSERT_EQ(metrics.percentiles.size(), 8U);
  EXPECT_TRUE(metrics.percentiles[1].time_s);
  EXPECT_FALSE(metrics.percentiles[2].time_s);
  EXPECT_NEAR(metrics.mean_escape_time_s, (55 + 10 * 10.5) / 20, 0.051);
}

TEST(RunMetrics, APersonWhoComesBackHasNotEscaped) {
  const Walk out_and_back = [](double time_s) -> Eigen::Vector2d {
    return {time_s > 1 && time_s < 5 ? 12 : 0, 0};
  };
  const RunMetrics metrics = measure(make_trace({out_and_back, standing({0, 0})}));
  EXPECT_DOUBLE_EQ(metrics.escape_curve.back(), 0);
  EXPECT_EQ(metrics.not_escaped, 2);
}

TEST(RunMetrics, TheDisasterIsNotAPerson) {
  world::Trace trace = make_trace({standing({0, 0}), standing({50, 0})});
  trace.header.role[1] = world::AgentRole::disaster;
  const RunMetrics metrics = measure(trace);
  EXPECT_EQ(metrics.people, 1);
  EXPECT_EQ(metrics.escape_curve.back(), 0);
}

TEST(RunMetrics, AnAttackerIsInNoFigure) {
  world::Trace trace = make_trace({standing({0, 0}), walking({-5, 0}, {1, 0})});
  trace.header.role[1] = world::AgentRole::attacker;
  const RunMetrics metrics = measure(trace);
  EXPECT_EQ(metrics.people, 1);
  EXPECT_EQ(metrics.escape_curve.back(), 0);
  EXPECT_EQ(metrics.exits.at(0).crossings.out, 0) << "though he walks through the door";
  EXPECT_EQ(metrics.persons.size(), 1U);
}

TEST(RunMetrics, CasualtiesAreCountedApart) {
  // One lies from 10 s on, one faints and gets up again, one is hurt but is carried out.
  world::Trace trace =
      make_trace({standing({0, 0}), standing({1, 0}), walking({-5, 0}, {1, 0}), standing({2, 0})});
  trace.header.state_names = {"Walk", "Casualty"};
  for (std::size_t step = 100; step < trace.steps(); ++step) {
    trace.state[trace.at(step, 0)] = 1;
    if (step < 200) trace.state[trace.at(step, 1)] = 1;
    trace.state[trace.at(step, 2)] = 1;
  }
  const RunMetrics metrics = measure(trace);
  EXPECT_EQ(metrics.people, 4);
  EXPECT_EQ(metrics.casualties, 1);
  EXPECT_EQ(metrics.not_escaped, 2) << "neither hurt nor out";
  ASSERT_TRUE(metrics.persons[0].hurt_s);
  EXPECT_NEAR(*metrics.persons[0].hurt_s, 10, 1e-9);
  for (const std::size_t person : {1U, 2U, 3U}) EXPECT_FALSE(metrics.persons[person].hurt_s);
  const nlohmann::json json = to_json(metrics);
  EXPECT_EQ(json.at("casualties"), 1);
  EXPECT_NEAR(json.at("by_person").at("hurt_s").at(0), 10, 1e-9);
  EXPECT_TRUE(json.at("by_person").at("hurt_s").at(1).is_null());
}

TEST(RunMetrics, CasualtiesAreInTheStatesThatTheTraceNames) {
  world::Trace trace = make_trace({standing({0, 0}), standing({1, 0})});
  trace.header.state_names = {"Dead_end", "Struck"};
  trace.header.state_lying = {0, 1};
  for (std::size_t step = 100; step < trace.steps(); ++step) trace.state[trace.at(step, 1)] = 1;
  const RunMetrics metrics = measure(trace);
  EXPECT_EQ(metrics.casualties, 1);
  EXPECT_FALSE(metrics.persons[0].hurt_s);
  EXPECT_TRUE(metrics.persons[1].hurt_s);
}

TEST(RunMetrics, IfAllAreOutOrHurtLaterFiguresAreKnown) {
  world::Trace trace = make_trace({standing({0, 0}), walking({-5, 0}, {1, 0})});
  trace.header.state_names = {"Walk", "Casualty"};
  for (std::size_t step = 100; step < trace.steps(); ++step) trace.state[trace.at(step, 0)] = 1;
  const RunMetrics metrics = measure(trace);
  ASSERT_TRUE(metrics.horizons[0].not_escaped) << "the run ends before 300 s";
  EXPECT_EQ(*metrics.horizons[0].not_escaped, 0);
}

TEST(RunMetrics, PeopleThatVanishAtASinkHaveEscapedAndUnusedAgentsAreNoPeople) {
  world::Trace trace = make_trace({standing({-1, 0}), standing({-1, 1}), standing({-2, 0})});
  for (std::size_t step = 0; step < trace.steps(); ++step) {
    if (step < 50 || step >= 200) trace.flags[trace.at(step, 0)] = 0;
    trace.flags[trace.at(step, 1)] = 0;
  }
  const RunMetrics metrics = measure(trace, place_with_door(2));
  EXPECT_EQ(metrics.people, 2);
  EXPECT_EQ(metrics.not_escaped, 1);
  EXPECT_DOUBLE_EQ(metrics.escape_curve[19], 0);
  EXPECT_DOUBLE_EQ(metrics.escape_curve[20], 0.5);
}

TEST(RunMetrics, SumsUpEachExit) {
  std::vector<Walk> walks = {walking({-1, 0}, {1, 0}), walking({-2, 0}, {1, 0}),
                             walking({-3, 30}, {1, 0})};
  world::Scenario scenario = place_with_door(2);
  scenario.exits.push_back(door(4));
  scenario.exits[1].id = "side";
  scenario.exits[1].from.y() += 30;
  scenario.exits[1].to.y() += 30;
  const world::Trace trace = make_trace(walks);
  const RunMetrics metrics = run_metrics(trace, scenario, exit_series(trace, scenario));
  ASSERT_EQ(metrics.exits.size(), 2U);
  EXPECT_EQ(metrics.exits[0].crossings.out, 2);
  EXPECT_EQ(metrics.exits[1].crossings.out, 1);
  EXPECT_NEAR(metrics.exits[0].share, 2.0 / 3, 1e-12);
  EXPECT_NEAR(metrics.exits[1].share, 1.0 / 3, 1e-12);
  EXPECT_DOUBLE_EQ(metrics.exits[1].width_m, 4);
}

TEST(RunMetrics, TimeInStatesIsThatOfTheSamples) {
  ExitSeries series{
      .exit_id = "door", .width_m = 2, .zone_area_m2 = 10, .samples = std::vector<ExitSample>(100)};
  for (int i = 40; i < 100; ++i) {
    series.samples[i].state = i < 60   ? ExitState::flowing
                              : i < 75 ? ExitState::congested
                                       : ExitState::clogged;
    series.samples[i].clogging_index = 0.5;
  }
  const world::Trace trace = make_trace({standing({0, 0})});
  const ExitTotals totals = run_metrics(trace, place_with_door(2), {series}).exits.at(0);
  EXPECT_NEAR(totals.demand_s, 6, 1e-9);
  EXPECT_NEAR(totals.congested_s, 4, 1e-9);
  EXPECT_NEAR(totals.clogged_s, 2.5, 1e-9);
  EXPECT_NEAR(totals.mean_clogging_index, 0.5, 1e-9);
}

TEST(RunMetrics, NobodyGivesNoNonsense) {
  const RunMetrics metrics = measure(make_trace({}));
  EXPECT_EQ(metrics.people, 0);
  EXPECT_EQ(metrics.mean_escape_time_s, 0);
  EXPECT_FALSE(metrics.percentiles.back().time_s);
  EXPECT_EQ(to_json(metrics).dump().find("nan"), std::string::npos);
}

TEST(RunMetrics, JsonHoldsEveryValue) {
  const RunMetrics metrics = measure(one_a_second(20, 10.5));
  const nlohmann::json json = to_json(metrics);
  EXPECT_EQ(json.at("definitions_version"), kDefinitionsVersion);
  EXPECT_EQ(json.at("people"), 20);
  EXPECT_EQ(json.at("not_escaped"), 10);
  EXPECT_EQ(json.at("duration_s"), metrics.duration_s);
  EXPECT_EQ(json.at("mean_escape_time_censored_s"), metrics.mean_escape_time_s);
  EXPECT_EQ(json.at("escape_curve").at("escaped_share"), metrics.escape_curve);
  EXPECT_EQ(json.at("escape_time_percentiles").at("t50_s"), *metrics.percentiles[1].time_s);
  EXPECT_TRUE(json.at("escape_time_percentiles").at("t90_s").is_null());
  EXPECT_EQ(json.at("exits").at(0).at("id"), "door");
}

}  // namespace
}  // namespace throng::metrics
