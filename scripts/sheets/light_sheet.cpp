// Compares the light of `standard` images with a path tracer: three places, each seen from three
// sides under a clear and an overcast sky and at night, without people.
//
//   light_sheet FOLDER [SAMPLES [BEFORE]]
//
// Writes FOLDER/PLACE_LIGHT_VIEW.png of the renderer and, with SAMPLES above 0,
// PLACE_LIGHT_VIEW.traced.png of the path tracer, and prints the median difference of their
// lightness. Both see the same triangles, mean albedos, sky, lamps, exposure, haze and film; the
// renderer adds the surfaces' detail, glass that mirrors, and has two bounces instead of six.
// BEFORE is a folder of another version's images, which are compared with the same traced ones.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/compute/parallel.h"
#include "base/compute/random.h"
#include "base/compute/srgb.h"
#include "base/files/files.h"
#include "base/geometry/angle.h"
#include "base/graphics/images/rgba_image.h"
#include "places/scenarios/blueprint/load_scenario.h"
#include "render/light/light_bake.h"
#include "render/light/place_light.h"
#include "render/renderer.h"
#include "render/scenery/metering.h"
#include "world/scenario.h"

namespace throng {
namespace {

namespace fs = std::filesystem;
using Eigen::Array3f;
using Eigen::Vector3f;
using render::Environment;
using render::Weather;

constexpr int kWidth = 256;
constexpr int kHeight = 144;
constexpr int kBounces = 6;

struct Lighting {
  std::string name;
  Environment environment;
};

std::vector<Lighting> lightings() {
  return {{"clear", {230 * kDegree, 45 * kDegree, Weather::clear, 20000, 0, 1}},
          {"overcast", {230 * kDegree, 45 * kDegree, Weather::overcast, 15000, 0, 1}},
          {"night", {130 * kDegree, -30 * kDegree, Weather::clear, 20000, 0, 1}}};
}

/// A view of the middle of a place, as a drone sees people there, in three directions and from
/// three heights.
camera::Camera make_view(const world::Scenario& scenario, int view) {
  const Eigen::Vector2d middle = 0.5 * (scenario.ground.min + scenario.ground.max);
  const double side_rad = (40 + 120 * view) * kDegree;
  const double height_m = 10 + 7 * view;
  const Eigen::Vector2d at =
      middle + 0.8 * height_m * Eigen::Vector2d(std::cos(side_rad), std::sin(side_rad));
  return {
      camera::intrinsics_from_hfov(kWidth, kHeight, 70 * kDegree),
      camera::pose_looking({at.x(), at.y(), height_m}, side_rad + 180 * kDegree, -45 * kDegree)};
}

double lightness(const std::uint8_t* rgb) {
  const auto linear = [](std::uint8_t byte) { return linear_from_encoded(byte / 255.0); };
  const double luminance =
      0.2126 * linear(rgb[0]) + 0.7152 * linear(rgb[1]) + 0.0722 * linear(rgb[2]);
  return luminance > 0.008856 ? 116 * std::cbrt(luminance) - 16 : 903.3 * luminance;
}

/// An image of the path tracer, and which of its pixels show a surface.
struct Traced {
  std::vector<std::uint8_t> rgb = std::vector<std::uint8_t>(std::size_t{3} * kWidth * kHeight);
  std::vector<bool> is_surface = std::vector<bool>(std::size_t{kWidth} * kHeight);
};

class PathTracer {
 public:
  PathTracer(const world::Scenario& scenario, const Environment& environment)
      : day_(render::daylight(environment)), sky_(environment, day_) {
    render::add_place(render::place_meshes(scenario, false), scenario,
                      (day_.lamps / day_.exposure).cast<float>(), rays_);
    lights_.emplace(rays_, sky_, day_,
                    day_.lamps_on ? render::all_lamps(scenario) : std::vector<render::Lamp>());
  }

  Traced trace(const camera::Camera& camera, double gain, int samples) const {
    Traced traced;
    std::vector<char> surface(traced.is_surface.size());
    parallel_ranges(kHeight, 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t y = begin; y < end; ++y) {
        for (std::size_t x = 0; x < kWidth; ++x) {
          const std::size_t pixel = y * kWidth + x;
          surface[pixel] =
              trace_pixel(camera, gain, samples, pixel, &traced.rgb[3 * pixel]) ? 1 : 0;
        }
      }
    });
    std::copy(surface.begin(), surface.end(), traced.is_surface.begin());
    return traced;
  }

 private:
  bool trace_pixel(const camera::Camera& camera, double gain, int samples, std::size_t pixel,
                   std::uint8_t* rgb) const {
    const Vector3f eye = camera.pose.center().cast<float>();
    const std::size_t row = pixel / kWidth;
    Array3f sum = Array3f::Zero();
    int hits = 0;
    for (int i = 0; i < samples; ++i) {
      Random random(1, Stream::environment, pixel * 100003 + static_cast<std::size_t>(i));
      const Eigen::Vector2d at(static_cast<double>(pixel % kWidth) + random.uniform(-0.5, 0.5),
                               static_cast<double>(row) + random.uniform(-0.5, 0.5));
      const Vector3f way =
          (camera.unproject(at, 1.0) - camera.pose.center()).normalized().cast<float>();
      const auto hit = rays_.trace(eye, way);
      if (!hit) continue;
      ++hits;
      bool behind = false;
      const Array3f light = lights_->radiance(eye, way, kBounces, random.bits(), behind);
      const float distance_m = (hit->position - eye).norm();
      const auto passed = static_cast<float>(std::exp(-day_.extinction_per_m * distance_m));
      // As air_before() of shaders/light.glsl.
      const float down = std::max(eye.z() - hit->position.z(), 0.0F) / distance_m;
      const Array3f air =
          day_.haze.cast<float>() * ((1 - 0.54F * down * (2 - down)) * (1 - passed));
      sum += light * static_cast<float>(day_.exposure) * passed + air;
    }
    if (hits < samples) return false;
    for (int c = 0; c < 3; ++c) {
      rgb[c] = static_cast<std::uint8_t>(
          std::lround(255 * render::film(gain * sum[c] / samples, day_.film_black)));
    }
    return true;
  }

  render::Daylight day_;
  render::SkyLight sky_;
  render::RayScene rays_;
  std::optional<render::LightRays> lights_;
};

void save(const fs::path& file, const std::vector<std::uint8_t>& rgb) {
  images::RgbaImage image(kWidth, kHeight);
  for (std::size_t i = 0; i < rgb.size() / 3; ++i) {
    std::copy_n(&rgb[3 * i], 3, &image.rgba[4 * i]);
    image.rgba[4 * i + 3] = 255;
  }
  write_file_atomically(file, images::encode_png(image));
}

std::vector<std::uint8_t> load(const fs::path& file) {
  const images::RgbaImage image = images::read_png(file);
  std::vector<std::uint8_t> rgb(std::size_t{3} * kWidth * kHeight);
  for (std::size_t i = 0; i < rgb.size() / 3; ++i) std::copy_n(&image.rgba[4 * i], 3, &rgb[3 * i]);
  return rgb;
}

double median_difference(const Traced& traced, const std::vector<std::uint8_t>& rgb) {
  std::vector<double> differences;
  for (std::size_t i = 0; i < traced.is_surface.size(); ++i) {
    if (!traced.is_surface[i]) continue;
    differences.push_back(std::abs(lightness(&traced.rgb[3 * i]) - lightness(&rgb[3 * i])));
  }
  const auto middle = differences.begin() + static_cast<std::ptrdiff_t>(differences.size() / 2);
  std::nth_element(differences.begin(), middle, differences.end());
  return *middle;
}

void run(const fs::path& folder, int samples, const fs::path& before) {
  const skinning::Population people = skinning::load_population(skinning::population_folder());
  for (const std::string place : {"city_square", "shopping_street", "station"}) {
    const world::Scenario scenario =
        scenarios::find_scenario(world::scenarios_folder(), place + "/everyday");
    for (const Lighting& lighting : lightings()) {
      render::Renderer renderer(scenario, people, lighting.environment, {"software"});
      std::optional<PathTracer> tracer;
      if (samples > 0) tracer.emplace(scenario, lighting.environment);
      for (int view = 0; view < 3; ++view) {
        const camera::Camera camera = make_view(scenario, view);
        const render::Scene nobody;
        const double gain = renderer.metered_gain(nobody, camera);
        const render::Frame frame = renderer.draw(nobody, camera, nullptr, {.exposure_gain = gain});
        const std::string name = fmt::format("{}_{}_{}", place, lighting.name, view);
        save(folder / (name + ".png"), frame.rgb);
        if (!tracer) continue;
        const Traced traced = tracer->trace(camera, gain, samples);
        save(folder / (name + ".traced.png"), traced.rgb);
        fmt::print("{:<28} median |dL| {:.1f}", name, median_difference(traced, frame.rgb));
        if (!before.empty())
          fmt::print(" (before {:.1f})", median_difference(traced, load(before / (name + ".png"))));
        fmt::print("\n");
        std::fflush(stdout);
      }
    }
  }
}

}  // namespace
}  // namespace throng

int main(int argc, char** argv) {
  if (argc < 2) {
    fmt::print(stderr, "usage: light_sheet FOLDER [SAMPLES [BEFORE]]\n");
    return EXIT_FAILURE;
  }
  try {
    throng::run(argv[1], argc > 2 ? std::atoi(argv[2]) : 256, argc > 3 ? argv[3] : "");
  } catch (const std::exception& error) {
    fmt::print(stderr, "light_sheet: {}\n", error.what());
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
