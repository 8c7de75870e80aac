// Tests of RiMEA (Richtlinie für mikroskopische Entfluchtungsanalysen, 4.1.1), but for those about
// bottlenecks in series and those about stairs, which a crowd in a plane does not have.
#include <fmt/core.h>

#include <cmath>

#include "base/compute/quantile.h"
#include "validation/criteria.h"
#include "validation/floors.h"
#include "validation/flow.h"
#include "validation/run.h"
#include "validation/suite.h"

namespace throng::validation {

using Eigen::Vector2d;

namespace {

constexpr std::uint64_t kSeed = 1;

Verdict one_in_corridor(const Tested& tested, Effort) {
  const Corridor walk = walk_corridor(tested, 1.33);
  return criteria::corridor_time(walk.time_s, walk.inside);
}

Verdict speed_over_density(const Tested& tested, Effort effort) {
  const std::vector<double> densities = effort == Effort::full
                                            ? std::vector<double>{0.5, 1, 2, 3, 4, 5, 6}
                                            : std::vector<double>{1, 3};
  std::vector<double> speeds;
  speeds.reserve(densities.size());
  for (const double density : densities) {
    speeds.push_back(walk_in_ring(tested, density, kSeed).speed_mps);
  }
  return criteria::falling_speeds(speeds);
}

Verdict pre_movement(const Tested& tested, Effort) {
  TestScene scene;
  scene.walls = room(8, 5, {{Side::right, 2.5, 1}});
  scene.behavior.goal_box(0, 10, 1.5, 12, 3.5);
  constexpr int kPeople = 10;
  for (int i = 0; i < kPeople; ++i) {
    const std::string name = fmt::format("Wait{}", i);
    Group group;
    group.places = {Vector2d(0.6 + 0.7 * i, 1 + (i % 3))};
    group.state = name;
    scene.groups.push_back(group);
    scene.behavior.add_state(name);
    scene.behavior.add_transition(name, "Walk",
                                  describe::timer(Sampled::constant(10 * (i + 1)), false));
  }
  scene.behavior.walk_to(0).leave_at_goal();
  crowd::Simulation crowd = load(scene, tested, kSeed);
  const std::vector<Eigen::Vector2f> begin(crowd.positions().begin(), crowd.positions().end());
  std::vector<double> started(kPeople, 0);
  const auto end = until_all_left(crowd, 300, [&](const crowd::Simulation& now) {
    constexpr float kStep = 0.01F;  // m
    for (std::size_t i = 0; i < started.size(); ++i) {
      const bool walks = now.states()[i] != static_cast<std::uint8_t>(i);
      if (started[i] == 0 && walks && (now.positions()[i] - begin[i]).norm() > kStep) {
        started[i] = now.time_s();
      }
    }
  });
  return criteria::start_times(started, end.has_value());
}

Verdict speeds_of_groups(const Tested& tested, Effort) {
  std::vector<criteria::AgeSpeeds> groups = {
      {0.58, 1.61, {}}, {1.41, 1.54, {}}, {0.68, 1.41, {}}, {0.46, 0.76, {}}};
  for (criteria::AgeSpeeds& group : groups) {
    group.measured_mps = walk_alone(tested, Sampled::uniform(group.min_mps, group.max_mps), 50);
  }
  return criteria::age_speeds(groups);
}

/// 30 m x 20 m, exits of 1 m in the walls at both ends, at 1/4 and 3/4 of their length.
std::optional<double> empty_hall(const Tested& tested, std::size_t people, bool right_too) {
  std::vector<Door> doors = {{Side::left, 5, 1}, {Side::left, 15, 1}};
  std::vector<crowd::Node> goals = {exit_goal(0, -3, 5), exit_goal(1, -3, 15)};
  if (right_too) {
    doors.push_back({Side::right, 5, 1});
    doors.push_back({Side::right, 15, 1});
    goals.push_back(exit_goal(2, 33, 5));
    goals.push_back(exit_goal(3, 33, 15));
  }
  TestScene scene;
  scene.walls = room(30, 20, doors);
  Group group;
  group.places = lattice({0.5, 0.5}, {29.5, 19.5}, people);
  group.aside_m = 0.05;
  scene.groups = {group};
  scene.behavior.add_goal_set(0, std::move(goals));
  scene.behavior.walk_to(0).leave_at_goal();
  crowd::Simulation crowd = load(scene, tested, kSeed);
  return until_all_left(crowd, 3600);
}

Verdict half_the_exits(const Tested& tested, Effort effort) {
  const std::size_t people = effort == Effort::full ? 1000 : 200;
  const auto four = empty_hall(tested, people, true);
  const auto two = empty_hall(tested, people, false);
  return criteria::exit_ratio(four, two);
}

Verdict exit_choice(const Tested& tested, Effort effort) {
  TestScene scene;
  scene.walls = room(30, 20, {{Side::bottom, 5, 1}, {Side::bottom, 20, 1}});
  Group group;
  group.places = lattice({0.5, 0.5}, {12.5, 19.5}, effort == Effort::full ? 600 : 150);
  group.aside_m = 0.05;
  scene.groups = {group};
  scene.behavior.add_goal_set(0, {describe::box_goal(0, {4, -4}, {6, -2}).set({"weight", 1}),
                                  describe::box_goal(1, {19, -4}, {21, -2}).set({"weight", 1})});
  scene.behavior.add_state("Walk",
                           {describe::select_goal("exit_choice", 0), describe::velocity("auto")});
  scene.behavior.leave_at_goal();
  crowd::Simulation crowd = load(scene, tested, kSeed);
  const std::vector<int> used = exits_used(crowd, {Vector2d(5, -1), Vector2d(20, -1)}, 1800);
  return criteria::exit_shares({used[0], used[1]}, static_cast<int>(crowd.agent_count()));
}

/// How long people need from a start area of 4 m x 50 m along a path of 4 m width: straight on for
/// so long, or round a corner.
std::optional<double> walk_path(const Tested& tested, std::size_t people, double straight_m,
                                std::uint64_t seed) {
  constexpr double kWidth = 4;
  TestScene scene;
  Group group;
  group.places = lattice({-50, 0.3}, {-0.5, kWidth - 0.3}, people);
  group.aside_m = 0.05;
  scene.groups = {group};
  if (straight_m > 0) {
    scene.walls = {box(-52, -1, straight_m + 5, 0), box(-52, kWidth, straight_m + 5, kWidth + 1),
                   box(-53, -1, -52, kWidth + 1)};
    scene.behavior.goal_box(0, straight_m, 0.5, straight_m + 4, kWidth - 0.5);
  } else {
    scene.walls = {box(-52, -1, 10 + kWidth + 1, 0), box(-52, kWidth, 10, 19),
                   box(-53, -1, -52, kWidth + 1), box(10 + kWidth, 0, 11 + kWidth, 19)};
    scene.behavior.goal_box(0, 10.5, kWidth + 10, 9.5 + kWidth, kWidth + 14);
  }
  scene.behavior.walk_to(0).leave_at_goal();
  crowd::Simulation crowd = load(scene, tested, seed);
  return until_all_left(crowd, 1800);
}

/// Median of the times of several runs, in which the last, slow person counts by chance; nothing
/// where most runs jam.
std::optional<double> median_walk(const Tested& tested, Effort effort, double straight_m) {
  const std::size_t people = effort == Effort::full ? 500 : 100;
  const std::uint64_t runs = effort == Effort::full ? 5 : 1;
  std::vector<double> times_s;
  for (std::uint64_t seed = 1; seed <= runs; ++seed) {
    times_s.push_back(walk_path(tested, people, straight_m, seed).value_or(INFINITY));
  }
  const double time_s = median(times_s);
  return std::isinf(time_s) ? std::nullopt : std::optional(time_s);
}

Verdict large_corner(const Tested& tested, Effort effort) {
  const auto shorter = median_walk(tested, effort, 20);
  const auto corner = median_walk(tested, effort, 0);
  const auto longer = median_walk(tested, effort, 28);
  return criteria::corner_times(shorter, corner, longer);
}

}  // namespace

std::vector<Test> rimea_tests() {
  return {
      {"rimea_1", "RiMEA 1", "one person, free speed 1.33 m/s, corridor of 2 m x 40 m",
       "26 to 34 s, inside of the corridor", one_in_corridor},
      {"rimea_4", "RiMEA 4",
       "endless corridor (a ring of 3 m x 79 m) with 0.5, 1, 2, 3, 4, 5, 6 people/m²",
       "reported; expected: speed falls with density", speed_over_density, false},
      {"rimea_5", "RiMEA 5",
       "room of 8 m x 5 m, exit of 1 m, ten people who begin to move after 10, 20, ..., 100 s",
       "each starts within 0.5 s of their time; all get out", pre_movement},
      {"rimea_6", "RiMEA 6", "20 people round a corner, corridor 2 m wide",
       "nobody crosses a wall; all get out",
       [](const Tested& tested, Effort) { return round_corner(tested, 1e9); }},
      {"rimea_7", "RiMEA 7", "50 people each of four ages, alone on a plain",
       "speeds within their group's range (0.58-1.61, 1.41-1.54, 0.68-1.41, 0.46-0.76) ± 0.03 m/s; "
       "means fall with age from the second on",
       speeds_of_groups},
      {"rimea_9", "RiMEA 9", "hall of 30 m x 20 m, 1000 people, four exits of 1 m, then two",
       "time with two / time with four in 1.6 to 2.4", half_the_exits},
      {"rimea_10", "RiMEA 10",
       "23 people in 12 rooms along a corridor, each assigned to one of two exits",
       "all take their exit", assigned_exits},
      {"rimea_11", "RiMEA 11",
       "hall of 30 m x 20 m, 600 people in its left part, two exits in one wall, behavior "
       "`exit_choice`",
       "reported; expected: all out, most by the nearer exit, some by the other", exit_choice,
       false},
      {"rimea_15", "RiMEA 15",
       "500 people, 4 m wide: 20 m straight, round a corner, 28 m straight; medians of 5 runs",
       "times grow in this order", large_corner},
      {"rimea_16", "RiMEA 16",
       "single file in a ring of 26 m, 10 to 40 people; free speeds 1.34, 0.8 and 1.6 m/s",
       "three quarters of the speeds within 0.25 m/s of (headway - 0.36 m) / 1.06 s, at most the "
       "free speed (Seyfried et al. 2005); slower free speed below, faster above",
       single_file},
  };
}

}  // namespace throng::validation
