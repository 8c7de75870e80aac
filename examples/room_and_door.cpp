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

namespace crowd = throng::crowd;
namespace describe = throng::crowd::describe;
using describe::Points;
using describe::Sampled;
using throng::InputError;

Points box(double min_x, double min_y, double max_x, double max_y) {
  return {{min_x, min_y}, {max_x, min_y}, {max_x, max_y}, {min_x, max_y}};
}

/// A room of 8 m x 6 m with its door in the middle of the wall at x = 0.
crowd::SceneDescription room(double door_m) {
  crowd::SceneBuilder scene;
  scene.add_profile(
      {.name = "adult",
       .common = {{"r", 0.2}, {"max_speed", 2.5}, {"max_accel", 5}, {"obstacleSet", 1}},
       .properties = {
           describe::property("pref_speed", Sampled::normal(1.34, 0.26).limited(0.6, 2.1))}});
  Points places;
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 10; ++column) {
      places.emplace_back(-7.2 + 0.7 * column, -2.2 + 0.9 * row);
    }
  }
  scene.add_group({.profile = "adult", .state = "Leave", .generator = describe::agents_at(places)});
  const double half_m = door_m / 2;
  scene.add_obstacles({box(-8.2, -3.2, 0, -3), box(-8.2, 3, 0, 3.2), box(-8.2, -3, -8, 3),
                       box(0, -3.2, 0.2, -half_m), box(0, half_m, 0.2, 3.2)});
  return scene.build();
}

crowd::BehaviorDescription leave_by_the_door() {
  crowd::BehaviorBuilder behavior;
  behavior.add_goal_set(0, {describe::box_goal(0, {4, -2}, {6, 2})});
  behavior.add_state("Leave", {describe::select_goal("nearest", 0), describe::velocity("auto")});
  behavior.add_final_state("Outside", {describe::action("leave")});
  behavior.add_transition("Leave", "Outside", describe::goal_reached());
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
