// Lower bounds: no run beats them, however its people walk; and what they are made of.
#include "metrics/bounds/run_bound.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "base/compute/random.h"
#include "metrics/basis/walking_distance.h"
#include "metrics/bounds/path_bound.h"
#include "metrics/evacuation.h"
#include "metrics/exits/door_capacity.h"
#include "tests/metrics/walks.h"

namespace throng::metrics {
namespace {

using Eigen::Vector2d;

/// Shortest path around boxes over all orders of their corners that a wall leaves free, by brute
/// force on a fine graph: every corner moved a hair outward.
double brute_force_m(const std::vector<world::Building>& boxes, const Vector2d& from,
                     const Vector2d& door_from, const Vector2d& door_to) {
  std::vector<Vector2d> nodes = {from};
  for (const world::Building& building : boxes) {
    Vector2d middle = Vector2d::Zero();
    for (const Vector2d& corner : building.footprint) middle += 0.25 * corner;
    for (const Vector2d& corner : building.footprint) {
      nodes.push_back(corner + 1e-7 * (corner - middle).normalized());
    }
  }
  const std::size_t walkers = nodes.size();
  constexpr int kDoorPoints = 400;
  for (int i = 0; i <= kDoorPoints; ++i) {
    nodes.emplace_back(door_from + (door_to - door_from) * i / kDoorPoints);
  }
  const auto free = [&](const Vector2d& a, const Vector2d& b) {
    for (const world::Building& building : boxes) {
      Vector2d min = building.footprint[0];
      Vector2d max = min;
      for (const Vector2d& corner : building.footprint) {
        min = min.cwiseMin(corner);
        max = max.cwiseMax(corner);
      }
      // Slabs: the part of a-b within the box has no length.
      double enter = 0;
      double leave = 1;
      for (int axis = 0; axis < 2; ++axis) {
        const double d = b[axis] - a[axis];
        if (std::abs(d) < 1e-15) {
          if (a[axis] <= min[axis] || a[axis] >= max[axis]) leave = -1;
          continue;
        }
        const double one = (min[axis] - a[axis]) / d;
        const double other = (max[axis] - a[axis]) / d;
        enter = std::max(enter, std::min(one, other));
        leave = std::min(leave, std::max(one, other));
      }
      if (leave - enter > 1e-9) return false;
    }
    return true;
  };
  std::vector<double> length_m(nodes.size(), std::numeric_limits<double>::infinity());
  std::vector<bool> done(nodes.size(), false);
  length_m[0] = 0;
  for (std::size_t round = 0; round < nodes.size(); ++round) {
    std::size_t next = nodes.size();
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (!done[i] && (next == nodes.size() || length_m[i] < length_m[next])) next = i;
    }
    done[next] = true;
    if (next >= walkers) return length_m[next];  // a door
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (done[i] || !free(nodes[next], nodes[i])) continue;
      length_m[i] = std::min(length_m[i], length_m[next] + (nodes[i] - nodes[next]).norm());
    }
  }
  return std::numeric_limits<double>::infinity();
}

TEST(PathBound, IsTheShortestPathAroundBoxes) {
  Random random(5, Stream::wind);
  for (int trial = 0; trial < 30; ++trial) {
    world::Scenario scenario = place_with_door(2);
    for (int i = 0; i < 6; ++i) {
      const Vector2d min(random.uniform(-16, -3), random.uniform(-12, 10));
      scenario.buildings.push_back(
          box(min, min + Vector2d(random.uniform(0.5, 2), random.uniform(0.5, 8))));
    }
    const PathBound paths(scenario, 0);
    for (int i = 0; i < 10; ++i) {
      const Vector2d from(-18, random.uniform(-15, 15));
      const double expected = brute_force_m(scenario.buildings, from, {0, -1}, {0, 1});
      EXPECT_NEAR(paths.to_door_m(0, from), expected, 1e-3) << trial;
      EXPECT_LE(paths.to_door_m(0, from), expected + 1e-5) << trial;
    }
  }
}

TEST(PathBound, IsNeverLongerThanTheEikonalEquationSays) {
  world::Scenario scenario = place_with_door(2);
  scenario.buildings = {box({-6, -20}, {-5, 4}), box({-9, 0}, {-8, 20})};
  const PathBound paths(scenario, 0);
  const WalkingDistance distance({{-20, -20}, {1, 20}}, scenario.buildings, scenario.exits[0]);
  for (double y = -15; y <= 15; y += 1.37) {
    const Vector2d from(-13, y);
    const double eikonal = distance.from(from).value();
    EXPECT_LE(paths.to_door_m(0, from), eikonal + 0.02) << y;
    EXPECT_GE(paths.to_door_m(0, from), 0.93 * eikonal) << y;
  }
}

TEST(PathBound, TheDoorIsWiderByTheBodies) {
  const world::Scenario scenario = place_with_door(2);
  EXPECT_NEAR(PathBound(scenario, 0).to_door_m(0, {-3, 5}), 5, 1e-9);
  EXPECT_NEAR(PathBound(scenario, 0.4).to_door_m(0, {-3, 5}), std::hypot(3, 3.6), 1e-9);
}

/// The figures of a run and its bound, which it must not beat.
void expect_bounded(const world::Trace& trace, const world::Scenario& scenario) {
  const RunMetrics run = run_metrics(trace, scenario, exit_series(trace, scenario));
  ASSERT_TRUE(run.lower_bound);
  for (const int percent : {1, 10, 25, 50, 75, 90, 95, 100}) {
    const auto time_s = run.escapes.percentile_s(percent);
    if (!time_s) continue;
    EXPECT_LE(run.lower_bound->percentile_s(percent).value(), *time_s + 1e-9) << percent;
  }
  EXPECT_LE(run.lower_bound->mean_s, run.mean_escape_time_s + 1e-9);
}

// People who go where they like at what speed they like: through the door one behind the other with
// no distance, beside the door, faster than they desire, arriving late, leaving before the alarm,
// gone in the middle of the scenario, and with the door closed before their eyes.
TEST(LowerBound, IsBeatenByNobody) {
  Random random(17, Stream::wind);
  for (int trial = 0; trial < 40; ++trial) {
    world::Scenario scenario = place_with_door(random.uniform(0.8, 3));
    add_alarm(scenario, trial % 3 == 0 ? 0 : random.uniform(1, 6));
    if (trial % 4 == 0) scenario.exits[0].closes_at_s = random.uniform(2, 8);
    if (trial % 5 == 0) scenario.exits[0].open = false;
    if (trial % 7 == 0) scenario.buildings.push_back(box({-4, -3}, {-3, 3}));
    std::vector<Walk> walks;
    for (int i = 0; i < 40; ++i) {
      const Vector2d start(random.uniform(-15, -1), random.uniform(-8, 8));
      const double speed = random.uniform(0.5, 6);
      const double from_s = random.uniform(0, 8);
      const bool beside = random.uniform(0, 1) < 0.2;
      const Vector2d door(0, random.uniform(-0.3, 0.3));
      const double to_door_s = (door - start).norm() / speed;
      walks.push_back([=](double time_s) -> Vector2d {
        const double walked_s = std::max(0.0, time_s - from_s);
        if (beside) return start - Vector2d(speed * walked_s, 0);
        if (walked_s < to_door_s) return start + (door - start) * (walked_s / to_door_s);
        return door + Vector2d(speed * (walked_s - to_door_s), 0);
      });
    }
    CrowdOfTest crowd;
    crowd.duration_s = 25;
    world::Trace trace = make_trace(walks, crowd);
    for (std::size_t agent = 0; agent < trace.agents(); ++agent) {
      const double arrives_s = random.uniform(0, 1) < 0.3 ? random.uniform(0, 10) : 0;
      const double vanishes_s = random.uniform(0, 1) < 0.1 ? random.uniform(10, 20) : 99;
      for (std::size_t step = 0; step < trace.steps(); ++step) {
        const double time_s = trace.time_s[step];
        if (time_s < arrives_s || time_s > vanishes_s) trace.flags[trace.at(step, agent)] = 0;
      }
    }
    SCOPED_TRACE(trial);
    expect_bounded(trace, scenario);
  }
}

// 200 people who stand at a door of 2 m: no more pass in t seconds than its capacity allows.
TEST(LowerBound, IsLimitedByTheDoor) {
  world::Scenario scenario = place_with_door(2);
  add_alarm(scenario, 0);
  const world::Trace trace = make_trace(std::vector<Walk>(200, standing({-0.1, 0})));
  const RunMetrics run = run_metrics(trace, scenario, exit_series(trace, scenario));
  const DoorCapacity capacity = door_capacity("ttc", 2);
  ASSERT_TRUE(run.lower_bound);
  EXPECT_EQ(run.lower_bound->raised_doors, 0);
  const double on_s = 10 / 1.3;
  const double expected = (200 - capacity.burst) / capacity.rate_per_s + on_s;
  EXPECT_NEAR(run.lower_bound->escape_s.back(), expected, 1.01);
  EXPECT_GT(run.lower_bound->escape_s.back(), 25);
}

// The doors are those of the model that moved the people, whatever the scenario was made for.
TEST(LowerBound, IsThatOfTheRunsModel) {
  world::Scenario scenario = place_with_door(2);
  scenario.crowd_model = "ttc";
  add_alarm(scenario, 0);
  world::Trace trace = make_trace(std::vector<Walk>(200, standing({-0.1, 0})));
  const auto last_s = [&] {
    return run_metrics(trace, scenario, exit_series(trace, scenario)).lower_bound->escape_s.back();
  };
  const auto expected = [](const char* model) {
    const DoorCapacity capacity = door_capacity(model, 2);
    return (200 - capacity.burst) / capacity.rate_per_s + 10 / 1.3;
  };
  EXPECT_NEAR(last_s(), expected("ttc"), 1.01) << "the trace does not say: the scenario's";
  trace.header.crowd.model = "helbing";
  EXPECT_NEAR(last_s(), expected("helbing"), 1.01);
  EXPECT_GT(std::abs(expected("helbing") - expected("ttc")), 3);
}

TEST(LowerBound, CountsFromTheLaterOfAlarmAndArrival) {
  world::Scenario scenario = place_with_door(2);
  add_alarm(scenario, 5);
  CrowdOfTest crowd;
  crowd.intent = -1;
  world::Trace trace =
      make_trace({walking({-2, 0}, {1.3, 0}, 5), walking({-2, 0}, {1.3, 0}, 20)}, crowd);
  for (std::size_t step = 0; step < 200; ++step) trace.flags[trace.at(step, 1)] = 0;
  const RunMetrics run = run_metrics(trace, scenario, exit_series(trace, scenario));
  // Both need 12 m at 1.3 m/s, from 5 and from 20 s on.
  EXPECT_NEAR(run.escapes.escape_s[0], 12 / 1.3, 0.11);
  EXPECT_NEAR(run.escapes.escape_s[1], 12 / 1.3, 0.11);
  for (const double bound_s : run.lower_bound->escape_s) {
    EXPECT_LE(bound_s, 12 / 1.3 + 0.11);
    EXPECT_GE(bound_s, 12 / 1.3 - 1.3);
  }
}

}  // namespace
}  // namespace throng::metrics
