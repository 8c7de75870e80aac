// How runs end for their people: by which exit each of them left, or otherwise.
#include "metrics/people/people_counts.h"

#include <gtest/gtest.h>

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
    scenario.inside.max.x() = end_m;
    CrowdOfTest crowd;
    crowd.duration_s = 7.5 + end_m;  // the run ends soon after the escape
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

TEST(PeopleCounts, TurningBackOutsideOfTheDoorIsLeavingThere) {
  const Walk turns = [](double time_s) -> Eigen::Vector2d {
    return {time_s < 3 ? 5 - time_s : time_s - 1, 0};
  };
  const Walk comes_in_and_leaves_by_a_gap = [](double time_s) -> Eigen::Vector2d {
    return {time_s < 6 ? 3 - time_s : time_s - 9, time_s < 6 ? 0 : time_s - 6};
  };
  const PeopleCounts counts = count_people_in(make_trace({turns, comes_in_and_leaves_by_a_gap}));
  EXPECT_EQ(counts.left_by[0].people, 1);
  EXPECT_EQ(counts.turned_back, 1);
  EXPECT_EQ(counts.left_by_no_exit, 1);
}

TEST(PeopleCounts, SurviveTheirJson) {
  PeopleCounts counts{21, {{"a", 1}, {"b", 2}}, 1, 3, 4, 5, 2, 3};
  EXPECT_EQ(to_json(people_counts_from(to_json(counts))), to_json(counts));
  EXPECT_EQ(counts.left(), 6);
}

}  // namespace
}  // namespace throng::metrics
