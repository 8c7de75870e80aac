// Why people are still inside at the end of a run.
#include "metrics/people/remaining.h"

#include <gtest/gtest.h>

#include "tests/metrics/walks.h"

namespace throng::metrics {
namespace {

using Eigen::Vector2d;

Remaining remaining_in(const world::Trace& trace, const world::Scenario& scenario) {
  return count_remaining(trace, scenario,
                         person_records(trace, scenario, world::find_alarm(scenario)),
                         walking_distances(scenario));
}

/// Sets a person's state at the last step.
void mark_end(world::Trace& trace, std::size_t agent, std::uint8_t flags, std::int8_t intent) {
  const std::size_t at = trace.at(trace.steps() - 1, agent);
  trace.flags[at] |= flags;
  trace.exit_intent[at] = intent;
}

CrowdOfTest two_minutes() {
  CrowdOfTest crowd;
  crowd.duration_s = 120;
  return crowd;
}

TEST(Remaining, EveryReasonOnce) {
  const Vector2d spot(-5, 0);
  // Out; casualty, guided, waiting, walking, stalled.
  world::Trace trace = make_trace({walking({-5, 0}, {0.5, 0}), standing(spot), standing(spot),
                                   standing(spot), walking({-19, 3}, {0.12, 0}), standing(spot)},
                                  two_minutes());
  mark_end(trace, 1, world::kFallen, 0);
  mark_end(trace, 2, world::kFollowing, -1);
  mark_end(trace, 3, 0, -1);
  const Remaining remaining = remaining_in(trace, place_with_door(2));
  EXPECT_EQ(remaining.casualty, 1);
  EXPECT_EQ(remaining.guided, 1);
  EXPECT_EQ(remaining.waiting, 1);
  EXPECT_EQ(remaining.blocked, 0);
  EXPECT_EQ(remaining.walking, 1);
  EXPECT_EQ(remaining.stalled, 1);
  EXPECT_EQ(remaining.total(), 5);
}

TEST(Remaining, NobodyLeavesByAShutDoorOrThroughWalls) {
  const world::Trace trace = make_trace({standing({-5, 0})}, two_minutes());
  world::Scenario closed = place_with_door(2);
  closed.exits[0].closes_at_s = 30;
  EXPECT_EQ(remaining_in(trace, closed).blocked, 1);
  world::Scenario walled = place_with_door(2);
  walled.buildings = {box({-8, -3}, {-2, -2}), box({-8, 2}, {-2, 3}), box({-8, -3}, {-7, 3}),
                      box({-3, -3}, {-2, 3})};
  EXPECT_EQ(remaining_in(trace, walled).blocked, 1);
  EXPECT_EQ(remaining_in(trace, place_with_door(2)).stalled, 1);
}

TEST(Remaining, RecentArrivalsAreOnTheirWay) {
  world::Trace trace = make_trace({standing({-5, 0})}, two_minutes());
  for (std::size_t step = 0; step < 800; ++step) trace.flags[trace.at(step, 0)] = 0;
  EXPECT_EQ(remaining_in(trace, place_with_door(2)).walking, 1);
}

TEST(Remaining, DepartedPeopleAreNotInside) {
  world::Trace trace = make_trace({standing({-5, 0})}, two_minutes());
  for (std::size_t step = 900; step < trace.steps(); ++step) trace.flags[trace.at(step, 0)] = 0;
  EXPECT_EQ(remaining_in(trace, place_with_door(2)).total(), 0);
}

}  // namespace
}  // namespace throng::metrics
