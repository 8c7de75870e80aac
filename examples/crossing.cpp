// Two streams of people cross at right angles: how much slower they walk than alone.
//
//   crossing [FOLDER]
//
// With a folder, what was built is also written there as Menge's files, which `throng crowd` runs.
#include <cstdio>
#include <filesystem>
#include <string>

#include "base/error.h"
#include "base/files/files.h"
#include "crowd/description/builder.h"
#include "crowd/description/menge_files/write.h"
#include "crowd/simulation.h"

namespace {

namespace crowd = throng::crowd;
namespace describe = throng::crowd::describe;
using describe::Points;
using describe::Sampled;
using throng::InputError;
using throng::crowd::Node;

constexpr double kFreeSpeedMps = 1.34;

/// Positions side by side at which a stream's people enter.
Points entrance(const Eigen::Vector2d& middle, const Eigen::Vector2d& along) {
  Points places;
  for (int i = -2; i <= 2; ++i) places.emplace_back(middle + 0.7 * i * along);
  return places;
}

crowd::SceneDescription crossing() {
  crowd::SceneBuilder scene;
  scene.add_profile(
      {.name = "adult",
       .common = {{"r", 0.2}, {"max_speed", 2}, {"max_accel", 5}},
       .properties = {describe::property("pref_speed", Sampled::normal(kFreeSpeedMps, 0.1))}});
  const Node arrivals = describe::typed("Arrivals", "rate", {{"per_second", 1.5}, {"end", 60}});
  scene.add_group({"adult", "East", describe::agents_at(entrance({-10, 0}, {0, 1})), {arrivals}});
  scene.add_group({"adult", "North", describe::agents_at(entrance({0, -10}, {1, 0})), {arrivals}});
  return scene.build();
}

crowd::BehaviorDescription straight_across() {
  crowd::BehaviorBuilder behavior;
  behavior.comment("Beyond the crossing.");
  behavior.add_goal_set(
      0, {describe::box_goal(0, {10, -3}, {12, 3}), describe::box_goal(1, {-3, 10}, {3, 12})});
  behavior.add_state("East", {describe::select_goal(0, 0), describe::velocity("goal")});
  behavior.add_state("North", {describe::select_goal(0, 1), describe::velocity("goal")});
  behavior.add_final_state("Gone", {describe::action("leave")});
  behavior.add_transition("East,North", "Gone", describe::goal_reached());
  return behavior.build();
}

/// Mean speed along the way of those in the middle.
double speed_in_the_middle(crowd::Simulation& crowd, double until_s) {
  double sum = 0;
  std::size_t samples = 0;
  while (crowd.time_s() < until_s) {
    crowd.step();
    for (std::size_t i = 0; i < crowd.agent_count(); ++i) {
      if (crowd.present()[i] == 0 || crowd.positions()[i].norm() > 3) continue;
      const bool east = crowd.state_names()[crowd.states()[i]] == "East";
      sum += static_cast<double>(east ? crowd.velocities()[i].x() : crowd.velocities()[i].y());
      ++samples;
    }
  }
  return samples > 0 ? sum / static_cast<double>(samples) : 0;
}

void write_files(const std::filesystem::path& folder) {
  throng::write_file_atomically(folder / "scene.xml", crowd::to_xml(crossing()));
  throng::write_file_atomically(folder / "behavior.xml", crowd::to_xml(straight_across()));
}

void run() {
  crowd::Simulation crowd(crossing(), straight_across(), {.seed = 4, .model = "weidmann"});
  const double speed_mps = speed_in_the_middle(crowd, 60);
  std::printf("%.2f m/s where the streams cross, %.2f m/s alone\n", speed_mps, kFreeSpeedMps);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc > 1) write_files(argv[1]);
    run();
  } catch (const InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
  return 0;
}
