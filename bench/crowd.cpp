// Agent-steps per second of the crowd engine. Open squares: everyone keeps walking to random
// places, sees at most 10 others within 5 m, at 0.5 or 2 people per m^2. Names tell the pedestrian
// model, the density in people per m^2, the number of agents and of threads.
#include <benchmark/benchmark.h>
#include <fmt/core.h>
#include <tbb/global_control.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "crowd/model.h"
#include "crowd/simulation.h"

namespace throng::crowd {
namespace {

std::filesystem::path write(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file) << text;
  return file;
}

/// `side`² agents; they turn around before they leave the square.
Simulation open_square(const std::string& model, int side, double density) {
  const double spacing = 1 / std::sqrt(density);
  const double half = 0.5 * spacing * (side - 1);
  const std::string scene = fmt::format(
      R"(<Experiment version="2.0"><SpatialQuery type="kd-tree"/><Common time_step="0.1"/>
  <Helbing agent_scale="2000" obstacle_scale="4000" reaction_time="0.5" body_force="1200"
           friction="2400" force_distance="0.015"/>
  <AgentProfile name="a">
    <Common r="0.2" pref_speed="1.3" max_speed="2" max_accel="5" neighbor_dist="5"
            max_neighbors="10"/>
    <ORCA tau="3" tauObst="0.15"/>
  </AgentProfile>
  <AgentGroup><ProfileSelector type="const" name="a"/><StateSelector type="const" name="Walk"/>
    <Generator type="rect_grid" anchor_x="{0}" anchor_y="{0}" offset_x="{1}" offset_y="{1}"
               count_x="{2}" count_y="{2}" displace_dist="u" displace_min="0" displace_max="{3}"/>
  </AgentGroup></Experiment>)",
      -half, spacing, side, 0.2 * spacing);
  std::string goals;
  for (int row = 0; row < 8; ++row) {
    for (int column = 0; column < 8; ++column) {
      goals += fmt::format(R"(<Goal id="{}" type="point" x="{}" y="{}"/>)", 8 * row + column,
                           half * (column - 3.5) / 3.5, half * (row - 3.5) / 3.5);
    }
  }
  const std::string behavior = fmt::format(
      R"(<BFSM><GoalSet id="0">{}</GoalSet>
  <State name="Walk" final="0"><GoalSelector type="random" goal_set="0"/>
    <VelComponent type="goal"/></State>
  <State name="Turn" final="0"/>
  <Transition from="Walk" to="Turn"><Condition type="or">
    <Condition type="goal_reached" distance="2"/>
    <Condition type="timer" per_agent="1" dist="u" min="3" max="9"/></Condition></Transition>
  <Transition from="Turn" to="Walk">
    <Condition type="timer" per_agent="1" dist="c" value="0.1"/></Transition></BFSM>)",
      goals);
  const auto folder =
      std::filesystem::temp_directory_path() / fmt::format("throng_bench_crowd_{}", getpid());
  std::filesystem::create_directories(folder);
  Simulation crowd(write(folder / "scene.xml", scene), write(folder / "behavior.xml", behavior),
                   {.model = model});
  std::filesystem::remove_all(folder);
  return crowd;
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

void step_city_square(benchmark::State& state, std::size_t threads) {
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
  const std::filesystem::path folder =
      std::filesystem::path(THRONG_SOURCE_DIR) / "scenarios/city_square";
  Simulation crowd(folder / "square_scene.xml", folder / "nearest_exit_behavior.xml", {});
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
    for (const std::string model : {"orca", "helbing"}) {
      for (const int side : {32, 100, 316, 1000}) {
        for (const double density : {0.5, 2.0}) add_open_square(model, density, side, threads);
      }
    }
    add("BM_Step/orca/city_square/agents:261", threads, 400,
        [=](benchmark::State& state) { step_city_square(state, threads); });
  }
  for (const ModelEntry& model : models()) {
    if (model.name == "orca" || model.name == "helbing") continue;
    for (const double density : {0.5, 2.0})
      add_open_square(std::string(model.name), density, 32, 1);
  }
  return true;
}

const bool kRegistered = register_all();

}  // namespace
}  // namespace throng::crowd
