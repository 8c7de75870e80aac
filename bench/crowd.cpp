// Agent-steps per second of the crowd engine. Open squares: everyone keeps walking to random
// places, sees at most 10 others within 5 m, at 0.5 or 2 people per m^2. Names tell the pedestrian
// model, the density in people per m^2, the number of agents and of threads.
#include <benchmark/benchmark.h>
#include <fmt/core.h>
#include <tbb/global_control.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "base/files/resources.h"
#include "crowd/description/builder.h"
#include "crowd/simulation.h"
#include "crowd/state/model.h"

namespace throng::crowd {
namespace {

/// `side`² agents; they turn around before they leave the square.
Simulation open_square(const std::string& model, int side, double density) {
  const double spacing = 1 / std::sqrt(density);
  const double half = 0.5 * spacing * (side - 1);
  SceneBuilder scene;
  scene.add(describe::model("Helbing", {{"agent_scale", 2000},
                                        {"obstacle_scale", 4000},
                                        {"reaction_time", 0.5},
                                        {"body_force", 1200},
                                        {"friction", 2400},
                                        {"force_distance", 0.015}}));
  scene.add_profile({.name = "a",
                     .common = {{"r", 0.2},
                                {"pref_speed", 1.3},
                                {"max_speed", 2},
                                {"max_accel", 5},
                                {"neighbor_dist", 5},
                                {"max_neighbors", 10}},
                     .models = {describe::model("ORCA", {{"tau", 3}, {"tauObst", 0.15}})}});
  scene.add_group({"a", "Walk",
                   describe::typed("Generator", "rect_grid",
                                   {{"anchor_x", -half},
                                    {"anchor_y", -half},
                                    {"offset_x", spacing},
                                    {"offset_y", spacing},
                                    {"count_x", side},
                                    {"count_y", side},
                                    {"displace_dist", "u"},
                                    {"displace_min", 0},
                                    {"displace_max", 0.2 * spacing}})});
  std::vector<Node> goals;
  for (int row = 0; row < 8; ++row) {
    for (int column = 0; column < 8; ++column) {
      goals.push_back(Node("Goal", {{"id", 8 * row + column},
                                    {"type", "point"},
                                    {"x", half * (column - 3.5) / 3.5},
                                    {"y", half * (row - 3.5) / 3.5}}));
    }
  }
  using describe::Sampled;
  BehaviorBuilder behavior;
  behavior.add_goal_set(0, std::move(goals));
  behavior.add_state("Walk", {describe::select_goal("random", 0), describe::velocity("goal")});
  behavior.add_state("Turn");
  behavior.add_transition(
      "Walk", "Turn",
      describe::condition("or", {},
                          {describe::goal_reached(2), describe::timer(Sampled::uniform(3, 9))}));
  behavior.add_transition("Turn", "Walk", describe::timer(Sampled::constant(0.1)));
  return {scene.build(), behavior.build(), {.model = model}};
}

void run(benchmark::State& state, Simulation crowd) {
  for (int i = 0; i < 20; ++i) crowd.step();
  for (auto _ : state) crowd.step();
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(crowd.agent_count()));
}

void step_open_square(benchmark::State& state, const std::string& model, int side, double density,
                      std::size_t threads) {
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
  run(state, open_square(model, side, density));
}

void step_city_square(benchmark::State& state, const std::string& model, std::size_t threads) {
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
  const std::filesystem::path folder = source_folder() / "scenarios/city_square";
  Simulation crowd(folder / "square_scene.xml", folder / "nearest_exit_behavior.xml",
                   {.model = model});
  while (crowd.time_s() < 25) crowd.step();  // in the middle of the flight
  run(state, std::move(crowd));
}

/// One thread is measured in CPU time, as the figures of other engines are; more in real time.
template <typename Function>
void add(const std::string& name, std::size_t threads, int iterations, Function function) {
  auto* bench =
      benchmark::RegisterBenchmark(fmt::format("{}/threads:{}", name, threads).c_str(), function);
  bench->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();
  if (threads > 1) bench->UseRealTime();
  if (iterations > 0) bench->Iterations(iterations);
}

void add_open_square(const std::string& model, double density, int side, std::size_t threads) {
  add(fmt::format("BM_Step/{}/open_square/density:{}/agents:{}", model, density, side * side),
      threads, 0,
      [=](benchmark::State& state) { step_open_square(state, model, side, density, threads); });
}

bool register_all() {
  for (const std::size_t threads : {1, 2}) {
    // The default model first, open and with walls.
    for (const std::string model : {"ttc", "orca"}) {
      add(fmt::format("BM_Step/{}/city_square/agents:261", model), threads, 400,
          [=](benchmark::State& state) { step_city_square(state, model, threads); });
    }
    for (const std::string model : {"ttc", "orca", "helbing"}) {
      for (const int side : {32, 100, 316, 1000}) {
        for (const double density : {0.5, 2.0}) add_open_square(model, density, side, threads);
      }
    }
  }
  for (const ModelEntry& model : models()) {
    if (model.name == "ttc" || model.name == "orca" || model.name == "helbing") continue;
    for (const double density : {0.5, 2.0})
      add_open_square(std::string(model.name), density, 32, 1);
  }
  return true;
}

const bool kRegistered = register_all();

}  // namespace
}  // namespace throng::crowd
