// A study: does a second door empty a hall faster? Both halls are simulated with the same seeds,
// and compared pair by pair.
//
//   study [SEEDS]
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "base/error.h"
#include "crowd/description/builder.h"
#include "crowd/simulation.h"

namespace {

namespace crowd = throng::crowd;
namespace describe = throng::crowd::describe;
using describe::Points;
using describe::Sampled;
using throng::InputError;
using throng::crowd::Node;

Points box(double min_x, double min_y, double max_x, double max_y) {
  return {{min_x, min_y}, {max_x, min_y}, {max_x, max_y}, {min_x, max_y}};
}

/// A hall of 12 m x 10 m with 100 people and a door of 1 m on the left, optionally also on the
/// right.
crowd::SceneDescription hall(bool two_doors) {
  crowd::SceneBuilder scene;
  scene.add_profile(
      {.name = "adult",
       .common = {{"r", 0.2}, {"max_speed", 2.5}, {"max_accel", 5}, {"obstacleSet", 1}},
       .properties = {
           describe::property("pref_speed", Sampled::normal(1.34, 0.26).limited(0.6, 2.1))}});
  // At random in the hall, elsewhere for every seed.
  scene.add_group({.profile = "adult",
                   .state = "Leave",
                   .generator = describe::typed(
                       "Generator", "scatter", {{"count", 100}, {"apart", 0.6}, {"clearance", 0.3}},
                       describe::vertices(box(-5.5, -4.5, 5.5, 4.5)))});
  std::vector<Points> walls = {box(-6.2, -5.2, 6.2, -5), box(-6.2, 5, 6.2, 5.2),
                               box(-6.2, -5, -6, -0.5), box(-6.2, 0.5, -6, 5)};
  if (two_doors) {
    walls.push_back(box(6, -5, 6.2, -0.5));
    walls.push_back(box(6, 0.5, 6.2, 5));
  } else {
    walls.push_back(box(6, -5, 6.2, 5));
  }
  scene.add_obstacles(walls);
  return scene.build();
}

crowd::BehaviorDescription leave(bool two_doors) {
  std::vector<Node> goals = {describe::box_goal(0, {-9, -1}, {-8, 1})};
  if (two_doors) goals.push_back(describe::box_goal(1, {8, -1}, {9, 1}));
  crowd::BehaviorBuilder behavior;
  behavior.add_goal_set(0, goals);
  behavior.add_state("Leave",
                     {describe::select_goal("exit_choice", 0), describe::velocity("auto")});
  behavior.add_final_state("Outside", {describe::action("leave")});
  behavior.add_transition("Leave", "Outside", describe::goal_reached());
  return behavior.build();
}

/// Time until all are out, in s.
double evacuation_s(bool two_doors, std::uint64_t seed) {
  constexpr double kMaxS = 600;
  crowd::Simulation crowd(hall(two_doors), leave(two_doors), {.seed = seed, .model = "weidmann"});
  while (!crowd.all_final() && crowd.time_s() < kMaxS) crowd.step();
  return crowd.time_s();
}

void run(int seeds) {
  double sum = 0;
  double squares = 0;
  for (int seed = 1; seed <= seeds; ++seed) {
    const auto number = static_cast<std::uint64_t>(seed);
    const double one_s = evacuation_s(false, number);
    const double two_s = evacuation_s(true, number);
    std::printf("seed %d: one door %.1f s, two doors %.1f s\n", seed, one_s, two_s);
    sum += one_s - two_s;
    squares += (one_s - two_s) * (one_s - two_s);
  }
  const double mean_s = sum / seeds;
  const double variance = (squares - seeds * mean_s * mean_s) / (seeds - 1);
  std::printf("the second door saves %.1f s on average (standard error %.1f s, %d pairs)\n", mean_s,
              std::sqrt(std::fmax(variance, 0) / seeds), seeds);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const int seeds = argc > 1 ? std::atoi(argv[1]) : 5;
    if (seeds < 2) {
      std::fprintf(stderr, "SEEDS must be a number from 2 on\n");
      return 2;
    }
    run(seeds);
  } catch (const InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
  return 0;
}
