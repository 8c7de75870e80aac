#include "spec/calibration/foreign/radial_lens.h"

#include <fmt/core.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/error.h"

namespace throng::calibrate {

namespace {

constexpr std::ptrdiff_t kFisheyeCoefficients = 4;

/// Distance of the farthest corner of the image from the axis, in focal lengths.
double corner_radius(const CameraFile& camera) {
  constexpr double kHalf = 0.5;  // from the center of a pixel to its edge
  const Parameters& p = camera.parameters;
  const auto farthest = [](double center, int side) {
    return std::max(std::abs(-kHalf - center), std::abs(side - kHalf - center));
  };
  return std::hypot(farthest(p[kCx], camera.size.width) / p[kFx],
                    farthest(p[kCy], camera.size.height) / p[kFy]);
}

struct Sample {
  double angle_rad;
  double radius;
};

/// The lens from the axis to the corner, or to the largest angle that it sees.
std::vector<Sample> sample(const RadialLens& lens, double corner) {
  constexpr int kSteps = 2000;
  std::vector<Sample> samples;
  double last = 0;
  for (int i = 1; i < kSteps; ++i) {
    const double angle = i * std::numbers::pi / kSteps;
    const double radius = lens(angle);
    if (!std::isfinite(radius) || radius <= last) break;
    samples.push_back({angle, radius});
    if (radius > corner) break;
    last = radius;
  }
  return samples;
}

}  // namespace

RadialLens fov_lens(double omega_rad) {
  return [=](double angle) {
    if (angle >= std::numbers::pi / 2) return 0.0;
    return std::atan(2 * std::tan(angle) * std::tan(omega_rad / 2)) / omega_rad;
  };
}

RadialLens double_sphere_lens(double xi, double alpha) {
  return [=](double angle) {
    const double z = std::cos(angle) + xi;
    const double second = std::hypot(std::sin(angle), z);
    return std::sin(angle) / (alpha * second + (1 - alpha) * z);
  };
}

RadialLens extended_unified_lens(double alpha, double beta) {
  return [=](double angle) {
    const double x = std::sin(angle);
    const double z = std::cos(angle);
    return x / (alpha * std::sqrt(beta * x * x + z * z) + (1 - alpha) * z);
  };
}

CameraFile as_fisheye(const CameraFile& pinhole, const RadialLens& lens,
                      const std::string& source) {
  constexpr double kSmallRad = 1e-4;
  const double slope = lens(kSmallRad) / kSmallRad;
  const std::vector<Sample> samples = sample(lens, corner_radius(pinhole));
  if (!std::isfinite(slope) || slope <= 0 || std::ssize(samples) < 2 * kFisheyeCoefficients) {
    throw InputError(Problem{source, "", "parameters of no lens",
                             "a distance from the axis that increases with the angle to it"});
  }
  // radius / slope = a + k1 a^3 + k2 a^5 + k3 a^7 + k4 a^9 of the angle a
  Eigen::MatrixXd powers(std::ssize(samples), kFisheyeCoefficients);
  Eigen::VectorXd rest(std::ssize(samples));
  for (std::ptrdiff_t row = 0; row < std::ssize(samples); ++row) {
    const Sample& one = samples[static_cast<std::size_t>(row)];
    rest[row] = one.radius / slope - one.angle_rad;
    double power = one.angle_rad;
    for (std::ptrdiff_t k = 0; k < kFisheyeCoefficients; ++k) {
      power *= one.angle_rad * one.angle_rad;
      powers(row, k) = power;
    }
  }
  const Eigen::VectorXd k = powers.colPivHouseholderQr().solve(rest);
  CameraFile camera = pinhole;
  camera.lens = Lens::fisheye;
  camera.parameters[kFx] *= slope;
  camera.parameters[kFy] *= slope;
  std::copy(k.begin(), k.end(), camera.parameters.begin() + kCoefficients);
  const double worst_px = (powers * k - rest).cwiseAbs().maxCoeff() *
                          std::max(camera.parameters[kFx], camera.parameters[kFy]);
  constexpr double kMaxErrorPx = 0.1;
  if (!(worst_px <= kMaxErrorPx)) {
    throw InputError(Problem{
        source, "",
        fmt::format("a lens from which throng's fisheye differs by {:.2g} px", worst_px),
        fmt::format("one that it shows within {} px: calibrate with another model", kMaxErrorPx)});
  }
  return camera;
}

}  // namespace throng::calibrate
