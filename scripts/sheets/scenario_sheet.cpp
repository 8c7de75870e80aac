// A place in everyday life and in its emergency, from several heights and in several weathers: the
// images of docs/shipped_scenarios.md. scripts/sheets/contact_sheet.sh makes them all.
//
//   scenario_sheet OUT.jpg WIDTH EVERYDAY TRACE [EMERGENCY TRACE]
//
// EVERYDAY and EMERGENCY are scenarios' ids, TRACE a run of each (`throng simulate`). The rows are
// day, evening, rain and the emergency; the columns are seen from 15, 30 and 60 m. WIDTH is that of
// a panel in pixels.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
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

constexpr double kShownS = 25;      // of the run, or its end
constexpr double kUmbrellas = 0.3;  // of the people, in the rain

struct View {
  double height_m;
  double pitch_deg;
};
constexpr std::array<View, 3> kViews = {{{15, -32}, {30, -42}, {60, -52}}};

const Environment kDay{230 * kDegree, 45 * kDegree, Weather::clear, 20000, 0, 1, 0};
const Environment kEvening{160 * kDegree, -4 * kDegree, Weather::clear, 20000, 0, 1, 0};
const Environment kRain{230 * kDegree, 30 * kDegree, Weather::rain, 5000, 6, 1, 0};
const Environment kSmoke{230 * kDegree, 45 * kDegree, Weather::clear, 20000, 0, 1, 1};

/// Panels side by side and one below the other.
class Sheet {
 public:
  Sheet(int width, int height, std::size_t rows)
      : width_(width), height_(height), rows_(rows), rgb_(rows * row_bytes()) {}

  void place(const render::Frame& frame, std::size_t row, std::size_t column) {
    const std::size_t line = static_cast<std::size_t>(width_) * 3;
    for (std::size_t y = 0; y < static_cast<std::size_t>(height_); ++y) {
      const auto from = frame.rgb.begin() + static_cast<std::ptrdiff_t>(y * line);
      const std::size_t to = row * row_bytes() + y * line * kViews.size() + column * line;
      std::copy_n(from, line, rgb_.begin() + static_cast<std::ptrdiff_t>(to));
    }
  }

  std::string jpeg() const {
    constexpr int kQuality = 85;
    return images::jpeg_bytes(rgb_, width_ * static_cast<int>(kViews.size()),
                              height_ * static_cast<int>(rows_), kQuality);
  }

 private:
  std::size_t row_bytes() const {
    return static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_) * 3 * kViews.size();
  }

  int width_;
  int height_;
  std::size_t rows_;
  std::vector<std::uint8_t> rgb_;
};

/// The point that the scenario's first drone sees at 45 degrees below the horizon: (x, y) on the
/// ground.
Eigen::Vector2d focus(const world::Scenario& scenario) {
  const world::DroneStart& drone = scenario.drones.at(0);
  return drone.position.head<2>() +
         drone.position.z() * Eigen::Vector2d(std::cos(drone.yaw_rad), std::sin(drone.yaw_rad));
}

camera::Camera camera_at(const world::Scenario& scenario, const View& view, int width, int height) {
  constexpr double kHfovDeg = 68;
  const double yaw = scenario.drones.at(0).yaw_rad;
  const double back_m = view.height_m / std::tan(-view.pitch_deg * kDegree);
  const Eigen::Vector2d at =
      focus(scenario) - back_m * Eigen::Vector2d(std::cos(yaw), std::sin(yaw));
  return {camera::intrinsics_from_hfov(width, height, kHfovDeg * kDegree),
          camera::pose_looking({at.x(), at.y(), view.height_m}, yaw, view.pitch_deg * kDegree)};
}

struct Run {
  world::Scenario scenario;
  world::Trace trace;
};

Run load(const std::string& id, const std::string& trace_file) {
  return {scenarios::find_scenario(world::scenarios_folder(), id), world::read_trace(trace_file)};
}

void draw_row(const Run& run, const Environment& environment, const skinning::Population& people,
              int width, int height, std::size_t row, Sheet& sheet) {
  render::Renderer renderer(run.scenario, people, environment, {"software"});
  const bool rains = environment.weather == Weather::rain;
  const render::Animator animator(run.trace, people, {.umbrellas = rains ? kUmbrellas : 0},
                                  run.scenario.stands, run.scenario.sitters);
  const double time_s = std::min(kShownS, run.trace.time_s.back());
  for (std::size_t column = 0; column < kViews.size(); ++column) {
    const camera::Camera camera = camera_at(run.scenario, kViews.at(column), width, height);
    const render::Scene scene = animator.scene_at(time_s, 0);
    const double gain = renderer.metered_gain(scene, camera);
    sheet.place(renderer.draw(scene, camera, nullptr, {.exposure_gain = gain}), row, column);
  }
}

void run(const std::vector<std::string>& arguments) {
  const int width = std::stoi(arguments.at(1));
  const int height = width * 9 / 16;
  const skinning::Population people = skinning::load_population(skinning::population_folder());
  const bool emergency = arguments.size() > 4;
  Sheet sheet(width, height, emergency ? 4 : 3);
  const Run everyday = load(arguments.at(2), arguments.at(3));
  draw_row(everyday, kDay, people, width, height, 0, sheet);
  draw_row(everyday, kEvening, people, width, height, 1, sheet);
  draw_row(everyday, kRain, people, width, height, 2, sheet);
  if (emergency) {
    draw_row(load(arguments.at(4), arguments.at(5)), kSmoke, people, width, height, 3, sheet);
  }
  write_file_atomically(arguments.at(0), sheet.jpeg());
}

}  // namespace
}  // namespace throng

int main(int argc, char** argv) {
  if (argc != 5 && argc != 7) {
    fmt::print(stderr, "usage: scenario_sheet OUT.jpg WIDTH EVERYDAY TRACE [EMERGENCY TRACE]\n");
    return EXIT_FAILURE;
  }
  try {
    throng::run({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    fmt::print(stderr, "scenario_sheet: {}\n", error.what());
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
