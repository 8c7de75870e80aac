// Tests of NIST Technical Note 1822 (Ronchi et al. 2013) that a crowd in a plane can be given.
#include <algorithm>
#include <array>

#include "validation/criteria.h"
#include "validation/floors.h"
#include "validation/run.h"
#include "validation/suite.h"
#include "validation/walking.h"

namespace throng::validation {

using Eigen::Vector2d;

namespace {

constexpr std::uint64_t kNistSeed = 1;

Verdict corridor_speed(const Tested& tested, Effort) {
  return criteria::corridor_speed(walk_corridor(tested, 1.0).time_s);
}

Verdict demographics(const Tested& tested, Effort) {
  return criteria::speed_distribution(
      walk_alone(tested, Sampled::normal(1.2, 0.2).limited(0.4, 2), 100));
}

/// How many of 100 people have crossed a corridor of 10 m x 2 m after two minutes, while so many
/// others come the other way.
int crossed(const Tested& tested, std::size_t others, std::uint64_t seed) {
  crowd::Simulation crowd = load(two_rooms(others), tested, seed);
  constexpr double kUntil = 120;  // s
  while (crowd.time_s() < kUntil) crowd.step();
  const auto present = crowd.present();
  return 100 -
         static_cast<int>(std::count(present.begin(), present.begin() + 100, std::uint8_t{1}));
}

Verdict counter_flow(const Tested& tested, Effort effort) {
  const std::vector<std::size_t> numbers = effort == Effort::full
                                               ? std::vector<std::size_t>{0, 10, 50, 100}
                                               : std::vector<std::size_t>{0, 100};
  std::vector<int> across;
  for (const std::size_t others : numbers) {
    constexpr std::size_t kRuns = 5;  // who blocks whom is a matter of chance
    std::array<int, kRuns> of_runs{};
    for (std::size_t run = 0; run < kRuns; ++run) {
      of_runs[run] = crossed(tested, others, run + 1);
    }
    std::nth_element(of_runs.begin(), of_runs.begin() + kRuns / 2, of_runs.end());
    across.push_back(of_runs[kRuns / 2]);
  }
  return criteria::falling_counts(across);
}

Verdict closing_exit(const Tested& tested, Effort) {
  TestScene scene;
  scene.walls = room(20, 10, {{Side::left, 5, 1}, {Side::right, 5, 1}});
  scene.later_walls = {box(-0.2, 4.4, 0, 5.6)};
  Group group;
  group.places = lattice({3, 1}, {9, 9}, 60);
  scene.groups = {group};
  scene.behavior.add_goal_set(0, {exit_goal(0, -2, 5), exit_goal(1, 22, 5)});
  scene.behavior.goal_box(1, 21.5, 4.5, 22.5, 5.5).walk_to(0);
  scene.behavior.add_state("Back", {describe::select_goal("nearest", 1), describe::velocity("auto"),
                                    describe::action("add_obstacle", {{"operand", 2}})});
  scene.behavior.add_transition(
      "Walk", "Back",
      describe::condition(
          "and", {},
          {describe::timer(Sampled::constant(10), false),
           describe::condition(
               "AABB",
               {{"min_x", 0.2}, {"min_y", -1}, {"max_x", 30}, {"max_y", 11}, {"inside", true}})}));
  scene.behavior.leave_at_goal("Walk,Back");
  crowd::Simulation crowd = load(scene, tested, kNistSeed);
  int early = 0;
  int late = 0;
  std::vector<std::uint8_t> counted(crowd.agent_count(), 0);
  const auto end = until_all_left(crowd, 600, [&](const crowd::Simulation& now) {
    for (std::size_t i = 0; i < counted.size(); ++i) {
      if (counted[i] != 0 || now.positions()[i].x() >= 0) continue;
      counted[i] = 1;
      ++(now.time_s() <= 12 ? early : late);
    }
  });
  return criteria::closed_exit(early, late, end.has_value());
}

Verdict congestion(const Tested& tested, Effort effort) {
  TestScene scene;
  scene.walls = room(8, 5, {{Side::right, 2.5, 2}});
  scene.walls.push_back(box(8.2, 0.5, 20, 1.5));
  scene.walls.push_back(box(8.2, 3.5, 20, 4.5));
  Group group;
  group.places = lattice({0.3, 0.3}, {7.7, 4.7}, effort == Effort::full ? 100 : 60);
  scene.groups = {group};
  scene.behavior.goal_box(0, 19, 2, 20, 3).walk_to(0).leave_at_goal();
  crowd::Simulation crowd = load(scene, tested, kNistSeed);
  // The greatest mean of three seconds of people in squares of 2 m: before the door, in the
  // corridor.
  double door = 0;
  double corridor = 0;
  double door_max = 0;
  double corridor_max = 0;
  const auto end = until_all_left(crowd, 300, [&](const crowd::Simulation& now) {
    int at_door = 0;
    int in_corridor = 0;
    for (std::size_t i = 0; i < now.agent_count(); ++i) {
      const Eigen::Vector2f& p = now.positions()[i];
      if (now.present()[i] == 0 || p.y() < 1.5F || p.y() > 3.5F) continue;
      if (p.x() >= 6 && p.x() < 8) ++at_door;
      if (p.x() >= 12 && p.x() < 14) ++in_corridor;
    }
    const double share = std::min(1.0, now.dt_s() / 3);
    door += share * (at_door / 4.0 - door);
    corridor += share * (in_corridor / 4.0 - corridor);
    door_max = std::max(door_max, door);
    corridor_max = std::max(corridor_max, corridor);
  });
  return criteria::congested_entrance(door_max, corridor_max, end.has_value());
}

}  // namespace

std::vector<Test> nist_tests() {
  return {
      {"nist_2_1", "NIST 2.1", "one person, free speed 1 m/s, corridor of 40 m", "1 ± 0.05 m/s",
       corridor_speed},
      {"nist_2_3", "NIST 2.3", "20 people round a corner, corridor 2 m wide",
       "nobody outside by more than 1 mm, all out within 60 s",
       [](const Tested& tested, Effort) { return round_corner(tested, 60); }},
      {"nist_2_4", "NIST 2.4", "100 people alone on a plain, free speeds N(1.2, 0.2)",
       "mean and deviation of their speeds within three standard errors", demographics},
      {"nist_2_8", "NIST 2.8",
       "100 people through a corridor of 10 m x 2 m against 0, 10, 50, 100 others, for 120 s; "
       "medians of 5 runs",
       "no more get across than against fewer (nothing is asked of how many)", counter_flow},
      {"nist_3_1", "NIST 3.1", "12 rooms, 23 people, each assigned to one of two exits",
       "all take their exit", assigned_exits},
      {"nist_4_1", "NIST 4.1", "60 people, two exits; the nearer closes after 10 s",
       "some leave by it before (2 s for those on the doorstep), none after; all out",
       closing_exit},
      {"nist_5_1", "NIST 5.1", "100 people from a room of 8 m x 5 m into a corridor 2 m wide",
       "denser before the corridor than in it (means of about 3 s in squares of 2 m)", congestion},
  };
}

}  // namespace throng::validation
