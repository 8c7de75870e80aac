// How long the figures of a run take: a crowd that walks to five doors, as it comes from a trace.
#include <benchmark/benchmark.h>

#include <tbb/global_control.h>
#include <cmath>

#include "base/compute/random.h"
#include "metrics/evacuation.h"
#include "metrics/exits/exits.h"

namespace throng::metrics {
namespace {

using Eigen::Vector2d;

constexpr int kSteps = 3000;
constexpr int kDoors = 5;

// Doors of 3 m in the wall x = 0, 12 m apart, between buildings.
world::Scenario wall_with_doors() {
  world::Scenario scenario;
  scenario.id = "bench";
  scenario.inside.bounds = {{-100, -100}, {5, 100}};
  for (int i = 0; i < kDoors; ++i) {
    world::Exit exit;
    exit.id = "door" + std::to_string(i);
    const double y = 12.0 * (i - 2);
    exit.from = {0, y - 1.5};
    exit.to = {0, y + 1.5};
    scenario.exits.push_back(exit);
    const double top = y + 10.5;
    scenario.buildings.push_back({"wall", {{0, y + 1.5}, {1, y + 1.5}, {1, top}, {0, top}}, 3});
  }
  return scenario;
}

// Everybody goes at 1.2 m/s to the nearest door, whose crowd lets four people a second through.
world::Trace random_walk_trace(int people, const world::Scenario& scenario) {
  world::Trace trace;
  trace.header.dt_s = 0.1;
  trace.header.role.assign(people, world::AgentRole::person);
  trace.header.radius_m.assign(people, 0.2F);
  trace.header.pref_speed_mps.assign(people, 1.2F);
  trace.header.group.assign(people, -1);
  for (const world::Exit& exit : scenario.exits) trace.header.exit_ids.push_back(exit.id);
  for (int step = 0; step < kSteps; ++step) {
    trace.time_s.push_back(step * 0.1);
    for (int i = 0; i < people; ++i) {
      Random random(1, Stream::run, static_cast<std::uint64_t>(i));
      const int door = i % kDoors;
      const double left_s = std::max(0.0, (i / kDoors) / 4.0 - step * 0.1);
      // They stand behind each other in a fan of 2.5 people per square meter.
      const double distance = std::sqrt(2 * (4 * left_s) / (2.5 * 2));
      const double angle = random.uniform(-1, 1);
      const double out = left_s > 0 ? 0 : 1.2 * (step * 0.1 - (i / kDoors) / 4.0);
      const Vector2d place(out - distance * std::cos(angle),
                           12.0 * (door - 2) + distance * std::sin(angle));
      trace.position.emplace_back(place.cast<float>());
      trace.velocity.emplace_back(0.5F, static_cast<float>(0.1 * angle));
      trace.yaw_rad.push_back(0);
      trace.desired_speed_mps.push_back(1.2F);
      trace.state.push_back(0);
      trace.exit_intent.push_back(static_cast<std::int8_t>(door));
      trace.flags.push_back(world::kPresent);
    }
  }
  return trace;
}

void figures_of_a_run(benchmark::State& state) {
  const tbb::global_control one_core(tbb::global_control::max_allowed_parallelism, 1);
  const world::Scenario scenario = wall_with_doors();
  const world::Trace trace = random_walk_trace(static_cast<int>(state.range(0)), scenario);
  for (auto _ : state) {
    benchmark::DoNotOptimize(run_metrics(trace, scenario, exit_series(trace, scenario)));
  }
}
BENCHMARK(figures_of_a_run)->Arg(260)->Arg(10000)->Unit(benchmark::kMillisecond)->Iterations(1);

}  // namespace
}  // namespace throng::metrics
