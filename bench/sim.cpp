// How many quadcopter steps a core flies per second, and how much faster than time a run is.
#include <benchmark/benchmark.h>
#include <fmt/core.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>

#include "base/files/resources.h"
#include "places/scenarios/blueprint/load_scenario.h"
#include "sim/fleet/flight.h"
#include "sim/planning/plan.h"
#include "sim/run.h"
#include "world/scenario.h"

namespace throng {
namespace {

constexpr double kPhysicsHz = 480;

const world::Scenario& city_square() {
  static const world::Scenario scenario =
      scenarios::find_scenario(source_folder() / "scenarios", "city_square/nearest_exit");
  return scenario;
}

// Drones on their way round the square, ten meters above each other's paths.
std::vector<sim::DroneMission> missions(int count) {
  std::vector<sim::DroneMission> list;
  for (int i = 0; i < count; ++i) {
    const double height_m = 20.0 + 10.0 * i;
    sim::DroneMission mission;
    mission.id = fmt::format("d{}", i);
    mission.start = Eigen::Vector3d(-10, -10, height_m);
    mission.policy = "waypoints";
    for (int lap = 0; lap < 100; ++lap) {
      for (const auto& [x, y] : {std::pair{10, -10}, {10, 10}, {-10, 10}, {-10, -10}}) {
        mission.waypoints.emplace_back(x, y, height_m);
      }
    }
    list.push_back(std::move(mission));
  }
  return list;
}

// Items: quadcopter physics steps, with policy, controller, collisions and samples.
void BM_Quad(benchmark::State& state) {
  const int drones = static_cast<int>(state.range(0));
  constexpr double kIntervalS = 0.1;
  std::vector<Problem> problems;
  const auto plan = sim::plan_drones(city_square(), missions(drones), 60, problems);
  double checksum = 0;
  sim::Flight flight(
      city_square().buildings, plan, kIntervalS, 1 / kPhysicsHz,
      {[&](std::size_t, const world::DroneSample& sample) { checksum += sample.position.x(); },
       [](const world::TraceEvent&) {}});
  for (auto _ : state) flight.advance();
  benchmark::DoNotOptimize(checksum);
  state.SetItemsProcessed(state.iterations() *
                          static_cast<std::int64_t>(drones * std::lround(kIntervalS * kPhysicsHz)));
}
BENCHMARK(BM_Quad)->Name("BM_Quad/f450")->ArgName("drones")->Arg(1)->Arg(3)->Arg(10);

// One drone that hovers above a crowd of 10 000, 1.3 m apart: what they cost while it is high up,
// and while it is low enough to meet them. Items: as above.
void BM_QuadAbovePeople(benchmark::State& state) {
  constexpr int kPeople = 10'000;
  constexpr int kAbreast = 100;
  constexpr float kApartM = 1.3F;
  constexpr double kIntervalS = 0.1;
  std::vector<Eigen::Vector2f> positions;
  for (int i = 0; i < kPeople; ++i) {
    positions.emplace_back(kApartM * static_cast<float>(i % kAbreast - kAbreast / 2),
                           kApartM * static_cast<float>(i / kAbreast - kAbreast / 2));
  }
  const std::vector<std::uint8_t> present(kPeople, 1);
  sim::DroneMission mission;
  mission.id = "d";
  mission.start = Eigen::Vector3d(0.5, 0.5, static_cast<double>(state.range(0)));
  std::vector<Problem> problems;
  const world::Scenario meadow;
  const auto plan = sim::plan_drones(meadow, {mission}, 60, problems);
  sim::Flight flight(
      meadow.buildings, plan, kIntervalS, 1 / kPhysicsHz,
      {[](std::size_t, const world::DroneSample&) {}, [](const world::TraceEvent&) {}});
  for (auto _ : state) flight.advance({positions, present});
  state.SetItemsProcessed(state.iterations() *
                          static_cast<std::int64_t>(std::lround(kIntervalS * kPhysicsHz)));
}
BENCHMARK(BM_QuadAbovePeople)
    ->Name("BM_Quad/above_10000_people")
    ->ArgName("height_m")
    ->Arg(20)
    ->Arg(5)
    ->Arg(2);

// A whole run with its trace. Items: simulated seconds, so items per second is how many times
// faster than real time it is.
void BM_Run(benchmark::State& state) {
  sim::RunSpec spec;
  spec.seed = 7;
  spec.duration_s = 120;
  spec.drones = missions(static_cast<int>(state.range(0)));
  const auto folder =
      std::filesystem::temp_directory_path() / fmt::format("bench_sim.{}", getpid());
  std::filesystem::create_directories(folder);
  for (auto _ : state) sim::simulate(city_square(), spec, folder / "run.h5");
  std::filesystem::remove_all(folder);
  state.SetItemsProcessed(state.iterations() * std::lround(spec.duration_s));
}
BENCHMARK(BM_Run)
    ->Name("BM_Run/city_square/agents:260")
    ->ArgName("drones")
    ->Arg(0)
    ->Arg(1)
    ->Arg(3)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime();

}  // namespace
}  // namespace throng
