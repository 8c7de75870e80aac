// People leave a room through a door: how long it takes, and how many pass per second.
//
//   room_and_door [WIDTH_M]
//
// The scene and the behavior are built in memory; no file is read or written.
#include <cstdio>
#include <cstdlib>
#include <string>

#include "base/error.h"
#include "crowd/description/builder.h"
#include "crowd/simulation.h"

namespace {

using namespace throng;
using namespace throng::crowd::describe;

Points box(double min_x, double min_y, double max_x, double max_y) {
  return {{min_x, min_y}, {max_x, min_y}, {max_x, max_y}, {min_x, max_y}};
}

/// A room of 8 m x 6 m with its door in the middle of the wall at x = 0.
crowd::SceneDescription room(double door_m) {
  crowd::SceneBuilder scene;
  scene.add_profile(
      {.name = "adult",
       .common = {{"r", 0.2}, {"max_speed", 2.5}, {"max_accel", 5}, {"obstacleSet", 1}},
       .properties = {property("pref_speed", Sampled::normal(1.34, 0.26).limited(0.6, 2.1))}});
  Points places;
  for (int i = 0; i < 60; ++i) places.emplace_back(-7.2 + 0.7 * (i / 6), -2.2 + 0.9 * (i % 6));
  scene.add_group({.profile = "adult", .state = "Leave", .generator = agents_at(places)});
  const double half_m = door_m / 2;
  scene.add_obstacles({box(-8.2, -3.2, 0, -3), box(-8.2, 3, 0, 3.2), box(-8.2, -3, -8, 3),
                       box(0, -3.2, 0.2, -half_m), box(0, half_m, 0.2, 3.2)});
  return scene.build();
}

crowd::BehaviorDescription leave_by_the_door() {
  crowd::BehaviorBuilder behavior;
  behavior.add_goal_set(0, {box_goal(0, {4, -2}, {6, 2})});
  behavior.add_state("Leave", {select_goal("nearest", 0), velocity("auto")});
  behavior.add_final_state("Outside", {action("leave")});
  behavior.add_transition("Leave", "Outside", goal_reached());
  return behavior.build();
}

void run(double door_m) {
  constexpr double kMaxS = 300;
  crowd::Simulation crowd(room(door_m), leave_by_the_door(), {.seed = 1, .model = "weidmann"});
  while (!crowd.all_final() && crowd.time_s() < kMaxS) crowd.step();
  std::size_t inside = 0;
  for (const auto present : crowd.present()) inside += present;
  const std::size_t out = crowd.agent_count() - inside;
  std::printf("door of %.2f m: %zu of %zu people out after %.1f s, %.2f per second\n", door_m, out,
              crowd.agent_count(), crowd.time_s(), static_cast<double>(out) / crowd.time_s());
}

}  // namespace

int main(int argc, char** argv) {
  try {
    run(argc > 1 ? std::strtod(argv[1], nullptr) : 1.0);
  } catch (const InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
  return 0;
}
