// How long calibrations take: 14 views of a board, and a bundle of 12 images with 400 points.
#include <benchmark/benchmark.h>

#include <numbers>

#include "base/compute/random.h"
#include "calibration/intrinsics.h"
#include "calibration/pose.h"
#include "tests/calibration/boards.h"

namespace {

namespace calibrate = throng::calibrate;

void fourteen_views(benchmark::State& state) {
  const calibrate::SyntheticViews views = calibrate::synthetic_views({}, 14, 0.2, 1);
  for (auto _ : state) {
    benchmark::DoNotOptimize(calibrate::calibrate_intrinsics(views.all, {}));
  }
}
BENCHMARK(fourteen_views)->Unit(benchmark::kMillisecond);

void bundle(benchmark::State& state) {
  constexpr int kImages = 12;
  constexpr int kPoints = 400;
  constexpr int kControlPoints = 6;
  const calibrate::SyntheticCamera lens;
  const calibrate::CameraFile camera{lens.lens, lens.parameters, lens.size};
  throng::Random random(1, throng::Stream::bootstrap);
  calibrate::ControlPoints control;
  std::vector<calibrate::NamedPixel> pixels;
  for (int i = 0; i < kPoints; ++i) {
    const Eigen::Vector3d point(random.uniform(-14, 14), random.uniform(-14, 14),
                                random.uniform(-0.5, 2.5));
    const std::string name = std::string("p").append(std::to_string(i));
    if (i < kControlPoints) control[name] = {point, 0.02};
    for (int v = 0; v < kImages; ++v) {
      const double yaw = 2 * std::numbers::pi * v / kImages;
      const Eigen::Vector3d at(-14 * std::cos(yaw), -14 * std::sin(yaw), 25 + 4 * (v % 3));
      const throng::camera::Camera seen{camera.intrinsics(),
                                        throng::camera::pose_looking(at, yaw, -1.05)};
      const auto shown = seen.project(point);
      if (!shown.visible || !lens.shows(shown.pixel)) continue;
      pixels.push_back(
          {"frame" + std::to_string(v),
           name,
           {shown.pixel.x() + random.normal(0, 0.2), shown.pixel.y() + random.normal(0, 0.2)}});
    }
  }
  state.counters["observations"] = static_cast<double>(pixels.size());
  for (auto _ : state) {
    benchmark::DoNotOptimize(calibrate::adjust_bundle(camera, control, pixels, {}));
  }
}
BENCHMARK(bundle)->Unit(benchmark::kMillisecond);

}  // namespace
