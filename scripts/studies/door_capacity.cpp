// The saturated flow of the pedestrian models through doors: what metrics/exits/door_capacity.cpp
// has its table from.
//
//   build/release/scripts/studies/door_capacity [MODEL ...]
//
// A crowd as dense as people stand (5 per m²) presses through a door in a wall, with the bodies and
// the speeds of people who flee in the places (radius 0.155 to 0.185 m, 2 ± 0.25 m/s). Of every
// window of 1 to 20 s, begun at every step while the door is saturated, the people who pass are
// counted. Printed are per model and width the 99.9 % quantiles of these counts, the rate (that of
// 20 s) and the burst with which burst + rate * t is at least the quantile of every window t.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "crowd/description/builder.h"
#include "crowd/simulation.h"
#include "crowd/state/model.h"
#include "metrics/basis/crossings.h"

namespace {

using namespace throng;
namespace describe = crowd::describe;

constexpr std::size_t kMaxWindowS = 20;  // windows of 1, 2, ... s
constexpr std::array kWidthsM = {0.8, 1.0, 1.2, 1.6, 2.0, 3.0, 4.0, 6.0, 10.0, 20.0};
constexpr double kPitchM = 0.447;  // 5 people per square meter
constexpr double kQuantile = 0.999;
constexpr double kMaxDurationS = 60;
constexpr int kSeeds = 4;
constexpr int kRows = 40;
constexpr double kWallM = 0.3;

describe::Points box(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

// The door is on x = 0, the crowd before it at x < 0.
crowd::Simulation crowd_before_door(const std::string& model, double width_m, std::uint64_t seed) {
  const double side_m = 0.5 * width_m + 4;
  const int columns = static_cast<int>(2 * (side_m - 0.5) / kPitchM);
  crowd::SceneBuilder scene;
  scene.add_profile(
      {.name = "a",
       .common = {{"max_neighbors", 10},
                  {"obstacleSet", 1},
                  {"neighbor_dist", 5},
                  {"class", 1},
                  {"max_speed", 3},
                  {"max_accel", 5},
                  {"max_angle_vel", 360}},
       .properties = {
           describe::property("pref_speed", describe::Sampled::normal(2, 0.25)),
           describe::property("r", describe::Sampled::uniform(crowd::kAdultRadiusM - 0.015,
                                                              crowd::kAdultRadiusM + 0.015))}});
  scene.add_group({"a", "Flee",
                   describe::typed("Generator", "rect_grid",
                                   {{"anchor_x", -1 - (kRows - 1) * kPitchM},
                                    {"anchor_y", -0.5 * (columns - 1) * kPitchM},
                                    {"offset_x", kPitchM},
                                    {"offset_y", kPitchM},
                                    {"count_x", kRows},
                                    {"count_y", columns},
                                    {"displace_dist", "u"},
                                    {"displace_min", 0},
                                    {"displace_max", 0.02}})});
  scene.add_obstacles(
      {box(0, -side_m - 1, kWallM, -0.5 * width_m), box(0, 0.5 * width_m, kWallM, side_m + 1),
       box(-30, -side_m - 1, 0, -side_m - 0.5), box(-30, side_m + 0.5, 0, side_m + 1)});
  const double reach = 0.5 * width_m - 0.3;
  crowd::BehaviorBuilder behavior;
  behavior.add_goal_set(0, {describe::box_goal(0, {0.3, -reach}, {1.3, reach})});
  behavior.add_goal_set(1, {describe::box_goal(0, {8, -side_m}, {9, side_m})});
  behavior.add_state("Flee", {describe::select_goal("nearest", 0), describe::velocity("auto")});
  behavior.add_state("Away", {describe::select_goal("nearest", 1), describe::velocity("auto")});
  behavior.add_final_state("Out", {describe::action("leave")});
  behavior.add_transition("Flee", "Away", describe::goal_reached(0.2));
  behavior.add_transition("Away", "Out", describe::goal_reached(1));
  return {scene.build(), behavior.build(), {.seed = seed, .model = model}};
}

// People gone out since the start, per step; as long as 20 % of the crowd is left.
std::vector<int> passages(const std::string& model, double width_m, std::uint64_t seed) {
  crowd::Simulation crowd = crowd_before_door(model, width_m, seed);
  world::Exit exit;
  exit.from = {0, -0.5 * width_m};
  exit.to = {0, 0.5 * width_m};
  constexpr double kMarginM = 0.22;
  const metrics::ExitLine line(exit, kMarginM, kMarginM);
  std::vector<metrics::CrossingCounter> counters(crowd.agent_count());
  std::vector<int> out = {0};
  const int enough = static_cast<int>(0.8 * static_cast<double>(crowd.agent_count()));
  while (crowd.time_s() < kMaxDurationS && out.back() < enough) {
    int net = out.back();
    for (std::size_t i = 0; i < crowd.agent_count(); ++i) {
      if (crowd.present()[i] == 0) continue;
      net += std::max(0, counters[i].step(line, crowd.positions()[i].cast<double>()));
    }
    out.push_back(net);
    crowd.step();
  }
  return out;
}

void measure(const std::string& model) {
  for (const double width_m : kWidthsM) {
    std::array<std::vector<int>, kMaxWindowS + 1> counts;
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
      const std::vector<int> out = passages(model, width_m, seed);
      for (std::size_t window_s = 1; window_s <= kMaxWindowS; ++window_s) {
        const std::size_t steps = 10 * window_s;
        for (std::size_t i = steps; i < out.size(); ++i) {
          counts[window_s].push_back(out[i] - out[i - steps]);
        }
      }
    }
    std::array<double, kMaxWindowS + 1> quantiles{};
    double rate = 0;
    for (std::size_t window_s = 1; window_s <= kMaxWindowS; ++window_s) {
      std::vector<int>& values = counts[window_s];
      if (values.empty()) break;
      std::sort(values.begin(), values.end());
      const double at = std::ceil(kQuantile * static_cast<double>(values.size())) - 1;
      quantiles[window_s] = values[static_cast<std::size_t>(at)];
      rate = quantiles[window_s] / static_cast<double>(window_s);  // of the longest that there is
    }
    double burst = 0;
    for (std::size_t window_s = 1; window_s <= kMaxWindowS; ++window_s) {
      burst = std::max(burst, quantiles[window_s] - rate * static_cast<double>(window_s));
    }
    fmt::print("{:<11} {:>5.1f}  {:>4.0f} {:>4.0f} {:>4.0f} {:>4.0f} {:>4.0f}  {:>7.2f} {:>6.1f}\n",
               model, width_m, quantiles[1], quantiles[2], quantiles[4], quantiles[10],
               quantiles[20], rate, burst);
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> models(argv + 1, argv + argc);
  if (models.empty()) {
    for (const crowd::ModelEntry& entry : crowd::models()) {
      if (entry.name != "dummy") models.emplace_back(entry.name);
    }
  }
  fmt::print("model       width   1 s  2 s  4 s 10 s 20 s   rate/s  burst\n");
  for (const std::string& model : models) measure(model);
}
