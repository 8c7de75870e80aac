// Frames per second of the renderer on the CPU: 1920 x 1080, a drone at 30 m looking down 45
// degrees with 70 degrees across, everything read back. LP_NUM_THREADS=0 gives the figure of one
// worker process per core.
#include <benchmark/benchmark.h>

#include <filesystem>
#include <numbers>

#include "../tests/render/synthetic_people.h"
#include "base/angle.h"
#include "base/random.h"
#include "render/allocator.h"
#include "render/renderer.h"

namespace throng::render {
namespace {

skinning::Population people_to_draw() {
  const std::filesystem::path folder = skinning::population_folder();
  return std::filesystem::exists(folder) ? skinning::load_population(folder) : synthetic_people(8);
}

world::Scenario square() {
  world::Scenario scenario;
  scenario.id = "bench";
  scenario.ground = {{-60, -60}, {60, 60}};
  scenario.ground_material = "pavers";
  for (const double x : {-45.0, 45.0}) {
    world::Building& building = scenario.buildings.emplace_back();
    building.footprint = {{x - 5, -30}, {x + 5, -30}, {x + 5, 30}, {x - 5, 30}};
  }
  return scenario;
}

/// Sees the ground from 10 m to 90 m in front of it; its middle is 30 m ahead.
camera::Camera drone() {
  return {camera::intrinsics_from_hfov(1920, 1080, 70 * kDegree),
          camera::pose_looking({0, -30, 30}, 90 * kDegree, -45 * kDegree)};
}

/// Walkers spread over what the drone sees.
Scene crowd(const skinning::Population& people, std::uint32_t count) {
  const camera::Camera camera = drone();
  Scene scene;
  for (std::uint32_t i = 0; i < count; ++i) {
    Random random(1, Stream::crowd_generator, i);
    PersonInstance person;
    person.agent = i;
    Eigen::Vector2d pixel;
    do {
      const Eigen::Vector2d at(random.uniform(-35, 35), random.uniform(-20, 40));
      person.position = {static_cast<float>(at.x()), static_cast<float>(at.y()), 0};
      pixel = camera.project(person.position.cast<double>()).pixel;
    } while (pixel.minCoeff() < 0 || pixel.x() > 1919 || pixel.y() > 1079);
    person.appearance = skinning::appearance_of(people, 1, i);
    person.yaw_rad = static_cast<float>(random.uniform(-3.1, 3.1));
    const double speed_mps = random.uniform() < 0.2 ? 2.8 : 1.3;
    person.pose = skinning::pose_at(people, random.uniform(), speed_mps, 0);
    scene.people.push_back(person);
  }
  return scene;
}

void draw(benchmark::State& state) {
  tune_allocator();
  const skinning::Population people = people_to_draw();
  const world::Scenario scenario = square();
  Renderer renderer(scenario, people, {}, {"software"});
  const Scene scene = crowd(people, static_cast<std::uint32_t>(state.range(0)));
  const camera::Camera camera = drone();
  std::size_t in_view = renderer.draw(scene, camera).people.size();
  for ([[maybe_unused]] auto _ : state) in_view = renderer.draw(scene, camera).people.size();
  state.SetItemsProcessed(state.iterations());
  state.counters["people_in_view"] = static_cast<double>(in_view);
}

BENCHMARK(draw)
    ->Name("BM_Draw/standard")
    ->ArgName("people")
    ->Arg(0)
    ->Arg(100)
    ->Arg(625)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

}  // namespace
}  // namespace throng::render
