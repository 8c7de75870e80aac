// How runs end for their people: by which exit each of them left, or otherwise.
#include "metrics/people/people_counts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "metrics/evacuation.h"
#include "tests/metrics/walks.h"

namespace throng::metrics {
namespace {

/// A place from -20 to 10 m whose door is at x = 0 and 2 m wide.
PeopleCounts count_people_in(const world::Trace& trace,
                             const world::Scenario& scenario = place_with_door(2)) {
  const PeopleTracker tracker = tracked(trace, scenario, world::find_alarm(scenario));
  return count_people(tracker.records(), scenario.exits);
}

TEST(PeopleCounts, APersonLeavesByTheDoorOrByAGap) {
  const world::Trace trace = make_trace({walking({-5, 0}, {1, 0}), walking({-5, 5}, {1, 0}),
                                         walking({-5, -3}, {-1, 0}), standing({-1, 0})});
  const PeopleCounts counts = count_people_in(trace);
  EXPECT_EQ(counts.people, 4);
  ASSERT_EQ(counts.left_by.size(), 1);
  EXPECT_EQ(counts.left_by[0].people, 1);
  EXPECT_EQ(counts.left_by_no_exit, 2);
  EXPECT_EQ(counts.inside, 1);
  ASSERT_EQ(count_warnings(counts).size(), 1);
  EXPECT_EQ(
      count_warnings(counts)[0].rfind("2 of 4 people left the place where there is no exit", 0), 0);
}

TEST(PeopleCounts, AnExitCountsPeopleLastHeadingForIt) {
  world::Scenario scenario = place_with_door(2);
  scenario.exits.push_back(door(2));
  scenario.exits[1].id = "outer";
  scenario.exits[1].from.x() = scenario.exits[1].to.x() = 5;
  const PeopleCounts counts = count_people_in(make_trace({walking({-5, 0}, {1, 0})}), scenario);
  EXPECT_EQ(counts.left_by[0].people, 0);
  EXPECT_EQ(counts.left_by[1].people, 1);
}

TEST(PeopleCounts, ThePlaceMayEndAtOrBeforeTheLineOfTheDoor) {
  for (const double end_m : {-1.0, -0.05, 0.0, 0.05, 0.15, 3.0}) {
    world::Scenario scenario = place_with_door(2);
    scenario.inside.bounds.max.x() = end_m;
    CrowdOfTest crowd;
    crowd.duration_s = 7.5 + std::max(0.0, end_m);  // the run ends soon after the escape
    const world::Trace trace =
        make_trace({walking({-7, 0}, {1, 0}), walking({-7, 3}, {1, 0})}, crowd);
    const PeopleCounts counts = count_people_in(trace, scenario);
    EXPECT_EQ(counts.left_by[0].people, 1) << end_m;
    EXPECT_EQ(counts.left_by_no_exit, 1) << end_m;
    if (end_m < 0) continue;
    const auto series = exit_series(trace, scenario);
    EXPECT_EQ(series[0].samples.back().net_out(), 1) << end_m;
  }
}

TEST(PeopleCounts, ARecordingThatEndsInsideIsNoEscape) {
  world::Trace trace = make_trace({walking({-5, 0}, {1, 0}), walking({-5, 0.5}, {1, 0})});
  trace.header.crowd.model = world::kRecordedCrowd;
  for (std::size_t step = 0; step < trace.steps(); ++step) {
    if (trace.time_s[step] > 4.5) trace.flags[trace.at(step, 0)] = 0;  // 0.5 m before the door
    if (trace.time_s[step] > 5.1) trace.flags[trace.at(step, 1)] = 0;  // 0.1 m behind it
  }
  const world::Scenario scenario = place_with_door(2);
  const RunMetrics metrics = run_metrics(trace, scenario, exit_series(trace, scenario));
  EXPECT_EQ(metrics.counts.vanished_inside, 1);
  EXPECT_EQ(metrics.counts.left_by[0].people, 1);
  EXPECT_EQ(metrics.not_escaped, 0) << "nobody is there at the end";
  EXPECT_EQ(metrics.remaining.total(), 0);
  EXPECT_NEAR(metrics.escapes.inside_s.at(0), 4.6, 1e-6) << "watched until the recording ends";
  EXPECT_EQ(metrics.exits[0].net_out(), 1);
}

TEST(PeopleCounts, PeopleNeverInsideAreNoEvacuees) {
  world::Scenario scenario = place_with_door(2);
  add_alarm(scenario, 3);
  const world::Trace trace = make_trace({standing({40, 0}), walking({-5, 0}, {1, 0})});
  const RunMetrics metrics = run_metrics(trace, scenario, exit_series(trace, scenario));
  EXPECT_EQ(metrics.people, 2);
  EXPECT_EQ(metrics.counts.never_inside, 1);
  EXPECT_EQ(metrics.escapes.left_before_alarm, 0);
  EXPECT_EQ(metrics.escapes.evacuees(), 1);
  EXPECT_TRUE(metrics.escapes.percentile_s(100).has_value());
}

TEST(PeopleCounts, TurningBackAtTheDoorIsNoEscape) {
  const Walk turns = [](double time_s) -> Eigen::Vector2d {
    return {time_s < 3 ? 5 - time_s : time_s - 1, 0};
  };
  const Walk comes_in_and_leaves_by_a_gap = [](double time_s) -> Eigen::Vector2d {
    return {time_s < 6 ? 3 - time_s : time_s - 9, time_s < 6 ? 0 : time_s - 6};
  };
  const Walk touches_the_line = [](double time_s) -> Eigen::Vector2d {
    return {std::abs(time_s - 3.1) - 0.1, 0};
  };
  world::Scenario scenario = place_with_door(2);
  add_alarm(scenario, 1);
  const world::Trace trace = make_trace({turns, comes_in_and_leaves_by_a_gap, touches_the_line,
                                         walking({-4, 0}, {1, 0}), standing({2, 0})});
  const RunMetrics metrics = run_metrics(trace, scenario, exit_series(trace, scenario));
  EXPECT_EQ(metrics.counts.left_by[0].people, 1);
  EXPECT_EQ(metrics.counts.turned_back, 3) << "who stays before the door is not in the place";
  EXPECT_EQ(metrics.counts.left_by_no_exit, 1);
  EXPECT_EQ(metrics.counts.never_inside, 0);
  EXPECT_EQ(count_warnings(metrics.counts).size(), 1U) << "of the gap only";
  EXPECT_EQ(metrics.escapes.evacuees(), 2);
  EXPECT_EQ(metrics.remaining.total(), 0);
  EXPECT_NEAR(metrics.percentiles.front().time_s.value(), 13.1, 0.11) << "14 m to the border";
  EXPECT_DOUBLE_EQ(metrics.escape_curve.back(), 1);
  const nlohmann::json turned_back = to_json(metrics).at("turned_back");
  EXPECT_EQ(turned_back.at("gone"), 2);
  EXPECT_NEAR(turned_back.at("max_stay_s"), 13.2, 0.11) << "touches the line at 3.1 s";
}

TEST(PeopleCounts, PeopleBesideAnExitAroundACornerAreInside) {
  // An exit in the inner corner of an L: this person is beyond its line, but behind a wall.
  world::Scenario scenario = place_with_door(2);
  scenario.buildings.push_back(box({0, -5}, {10, -4}));
  const PeopleCounts counts = count_people_in(make_trace({standing({1, -6})}), scenario);
  EXPECT_EQ(counts.inside, 1);
  scenario.buildings.clear();
  EXPECT_EQ(count_people_in(make_trace({standing({1, -6})}), scenario).turned_back, 1);
}

TEST(PeopleCounts, ThoseWhoComeBackCountAsTheRunEnded) {
  const Walk returns = [](double time_s) -> Eigen::Vector2d {
    return {time_s < 20 ? -5 + time_s : std::max(-5.0, 35 - time_s), 0};
  };
  const Walk leaves_again = [](double time_s) -> Eigen::Vector2d {
    const double in_m = std::max(-3.0, 35 - time_s);
    return {time_s < 20 ? -5 + time_s : time_s < 45 ? in_m : time_s - 48, 0};
  };
  world::Trace trace = make_trace({returns, leaves_again, walking({-5, 0}, {1, 0})});
  for (const bool is_recorded : {false, true}) {
    if (is_recorded) trace.header.crowd.model = world::kRecordedCrowd;
    const world::Scenario scenario = place_with_door(2);
    const RunMetrics metrics = run_metrics(trace, scenario, exit_series(trace, scenario));
    EXPECT_EQ(metrics.counts.inside, 1);
    EXPECT_EQ(metrics.counts.left_by[0].people, 2);
    EXPECT_EQ(metrics.exits[0].net_out(), 2);
    EXPECT_EQ(metrics.not_escaped, 1);
    EXPECT_NEAR(metrics.escapes.escape_s.at(0), 15.1, 0.11);
    EXPECT_NEAR(metrics.escapes.escape_s.at(1), 58.1, 0.11) << "when out for good";
  }
}

TEST(PeopleCounts, AnExitFarBeyondTheBorderCountsThoseWhoPassItAfterwards) {
  world::Scenario scenario = place_with_door(2);
  scenario.inside.bounds.max.x() = -6;
  world::Trace trace =
      make_trace({walking({-9, 0}, {1, 0}), walking({-9, 4}, {1, 0}), walking({-9, 0.5}, {1, 0})});
  for (std::size_t step = 0; step < trace.steps(); ++step) {
    if (trace.time_s[step] > 8.95) trace.flags[trace.at(step, 2)] = 0;  // 0.1 m before the line
  }
  const PeopleTracker tracker = tracked(trace, scenario, world::find_alarm(scenario));
  const std::vector<PersonRecord> people = tracker.records();
  EXPECT_EQ(people[0].left_by, 0);
  EXPECT_NEAR(people[0].escaped_s.value(), 9, 0.11);
  EXPECT_EQ(people[1].left_by, std::nullopt);
  EXPECT_NEAR(people[1].escaped_s.value(), 3.1, 0.11) << "beside the exit: at the border";
  EXPECT_EQ(people[2].left_by, 0) << "removed just before the line";
  EXPECT_NEAR(people[2].escaped_s.value(), 9, 0.11);
}

TEST(PeopleCounts, PeopleBetweenTheBorderAndTheExitAreInside) {
  world::Scenario scenario = place_with_door(2);
  scenario.inside.bounds.max.x() = -1;
  const Walk waits_before_the_door = [](double time_s) -> Eigen::Vector2d {
    return {std::min(-5 + time_s, -0.3), 1.5};
  };
  const PeopleCounts counts = count_people_in(make_trace({waits_before_the_door}), scenario);
  EXPECT_EQ(counts.inside, 1);
}

TEST(PeopleCounts, AnLShapedScenarioEndsAtItsPolygon) {
  world::Scenario scenario = place_with_door(2);
  scenario.inside.outline = {{-20, -20}, {0, -20}, {0, 2}, {10, 2}, {10, 20}, {-20, 20}};
  const std::vector<PersonRecord> people =
      tracked(make_trace({walking({-5, 0}, {1, 0}), walking({-5, 5}, {1, 0})}), scenario,
              world::find_alarm(scenario))
          .records();
  EXPECT_NEAR(people[0].escaped_s.value(), 5.1, 0.11);
  EXPECT_EQ(people[0].left_by, 0);
  EXPECT_NEAR(people[1].escaped_s.value(), 15.1, 0.11);
}

TEST(PeopleCounts, ADoorInTwoHalvesCountsEverybodyOnce) {
  for (const double gap_m : {0.0, 0.1, 0.3}) {
    world::Scenario scenario = place_with_door(2);
    scenario.exits.push_back(scenario.exits[0]);
    scenario.exits[1].id = "other";
    scenario.exits[0].to.y() = -0.5 * gap_m;
    scenario.exits[1].from.y() = 0.5 * gap_m;
    std::vector<Walk> walks;
    for (int i = -10; i <= 10; ++i) walks.push_back(walking({-5, 0.1 * i}, {1, 0.02}));
    const world::Trace trace = make_trace(walks);
    const RunMetrics metrics = run_metrics(trace, scenario, exit_series(trace, scenario));
    EXPECT_EQ(metrics.exits[0].net_out() + metrics.exits[1].net_out(), 21) << gap_m;
    EXPECT_EQ(metrics.counts.left_by[0].people, metrics.exits[0].net_out());
    EXPECT_EQ(metrics.counts.left_by[1].people, metrics.exits[1].net_out());
    EXPECT_EQ(metrics.counts.left_by_no_exit, 0);
  }
}

TEST(PeopleCounts, SurviveTheirJson) {
  PeopleCounts counts{21, {{"a", 1}, {"b", 2}}, 3, 4, 5, 2, 1, 3};
  EXPECT_EQ(to_json(people_counts_from(to_json(counts))), to_json(counts));
  EXPECT_EQ(counts.left(), 6);
}

}  // namespace
}  // namespace throng::metrics
