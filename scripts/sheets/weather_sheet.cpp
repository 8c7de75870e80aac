// The image docs/weather.jpg: city_square at several hours and in several weathers.
//
//   weather_sheet TRACE OUT.jpg [PANEL]
//
// TRACE is of city_square/nearest_exit (`throng simulate`). With the number of a panel, that one
// alone, at full size.
#include <fmt/core.h>

#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

#include "base/files/files.h"
#include "base/geometry/angle.h"
#include "base/graphics/images/jpeg_writer.h"
#include "places/scenarios/blueprint/load_scenario.h"
#include "render/animator.h"
#include "render/renderer.h"
#include "skinning/population.h"
#include "world/scenario.h"
#include "world/trace.h"

namespace throng {
namespace {

using render::Environment;
using render::Weather;

constexpr int kWidth = 1280;
constexpr int kHeight = 720;
constexpr std::size_t kColumns = 2;
constexpr double kTimeS = 26;
constexpr double kUmbrellas = 0.2;  // of the people, in the rain

std::vector<Environment> panels() {
  const auto panel = [](double azimuth_deg, double elevation_deg, Weather weather,
                        double visibility_m, double rain_mm_per_h = 0) {
    return Environment{azimuth_deg * kDegree, elevation_deg * kDegree, weather,
                       visibility_m,          rain_mm_per_h,           1};
  };
  return {panel(230, 45, Weather::clear, 20000),    panel(160, 5, Weather::clear, 20000),
          panel(155, -4, Weather::clear, 20000),    panel(130, -30, Weather::clear, 20000),
          panel(230, 45, Weather::overcast, 15000), panel(230, 30, Weather::fog, 500),
          panel(230, 30, Weather::rain, 5000, 8),   panel(230, -20, Weather::rain, 5000, 4)};
}

render::Frame draw(const Environment& environment, const world::Trace& trace,
                   const skinning::Population& people, const world::Scenario& scenario) {
  render::Renderer renderer(scenario, people, environment, {"software"});
  const bool rains = environment.weather == Weather::rain;
  const render::Animator animator(trace, people, {.umbrellas = rains ? kUmbrellas : 0},
                                  scenario.stands, scenario.sitters);
  const camera::Camera camera{camera::intrinsics_from_hfov(kWidth, kHeight, 70 * kDegree),
                              camera::pose_looking({26, -4, 20}, 178 * kDegree, -36 * kDegree)};
  const render::Scene scene = animator.scene_at(kTimeS, 0);
  return renderer.draw(scene, camera, nullptr,
                       {.exposure_gain = renderer.metered_gain(scene, camera)});
}

/// Adds a frame at half its size.
void place(const render::Frame& frame, std::size_t panel, std::vector<std::uint8_t>& sheet) {
  for (std::size_t y = 0; y < kHeight / 2; ++y) {
    for (std::size_t x = 0; x < kWidth / 2; ++x) {
      for (std::size_t channel = 0; channel < 3; ++channel) {
        const std::size_t from = (2 * y * kWidth + 2 * x) * 3 + channel;
        const int sum = frame.rgb[from] + frame.rgb[from + 3] + frame.rgb[from + 3 * kWidth] +
                        frame.rgb[from + 3 * kWidth + 3];
        const std::size_t row = panel / kColumns * (kHeight / 2) + y;
        const std::size_t column = panel % kColumns * (kWidth / 2) + x;
        sheet[(row * (kWidth / 2) * kColumns + column) * 3 + channel] =
            static_cast<std::uint8_t>((sum + 2) / 4);
      }
    }
  }
}

void run(const std::string& trace_file, const std::string& out, const char* chosen) {
  const world::Scenario scenario =
      scenarios::find_scenario(world::scenarios_folder(), "city_square/nearest_exit");
  const world::Trace trace = world::read_trace(trace_file);
  const skinning::Population people = skinning::load_population(skinning::population_folder());
  const std::vector<Environment> all = panels();
  constexpr int kQuality = 88;
  if (chosen != nullptr) {
    const render::Frame frame = draw(all.at(std::stoul(chosen)), trace, people, scenario);
    write_file_atomically(out, images::jpeg_bytes(frame.rgb, kWidth, kHeight, kQuality));
    return;
  }
  const std::size_t rows = (all.size() + kColumns - 1) / kColumns;
  std::vector<std::uint8_t> sheet(kColumns * rows * (kWidth / 2) * (kHeight / 2) * 3);
  for (std::size_t i = 0; i < all.size(); ++i) {
    place(draw(all[i], trace, people, scenario), i, sheet);
  }
  write_file_atomically(out, images::jpeg_bytes(sheet, kColumns * (kWidth / 2),
                                                static_cast<int>(rows) * (kHeight / 2), kQuality));
}

}  // namespace
}  // namespace throng

int main(int argc, char** argv) {
  if (argc < 3) {
    fmt::print(stderr, "usage: weather_sheet TRACE OUT.jpg [PANEL]\n");
    return EXIT_FAILURE;
  }
  try {
    throng::run(argv[1], argv[2], argc > 3 ? argv[3] : nullptr);
  } catch (const std::exception& error) {
    fmt::print(stderr, "weather_sheet: {}\n", error.what());
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
