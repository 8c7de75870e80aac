#include "render/light/sky_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/geometry/angle.h"

namespace throng::render {

namespace {

using Eigen::Array3d;
using Eigen::Vector3d;

constexpr int kRows = 32;
constexpr int kColumns = 64;

/// Turbidity of clear air with a visibility of some 20 km.
constexpr double kTurbidity = 3;

/// Perez's distribution relative to the zenith: `c` are its five coefficients.
double perez(const std::array<double, 5>& c, double cos_zenith, double gamma_rad) {
  const double cos_gamma = std::cos(gamma_rad);
  return (1 + c[0] * std::exp(c[1] / std::max(cos_zenith, 0.01))) *
         (1 + c[2] * std::exp(c[3] * gamma_rad) + c[4] * cos_gamma * cos_gamma);
}

/// Coefficients that are linear in the turbidity (Preetham et al. 1999, appendix A.2).
std::array<double, 5> linear(const std::array<std::array<double, 2>, 5>& terms) {
  std::array<double, 5> c{};
  for (std::size_t i = 0; i < c.size(); ++i) c[i] = terms[i][0] * kTurbidity + terms[i][1];
  return c;
}

/// Chromaticity of the zenith: cubic in the sun's angle from it, quadratic in the turbidity.
double zenith_chromaticity(const std::array<std::array<double, 4>, 3>& terms, double sun_rad) {
  const std::array<double, 3> turbidity = {kTurbidity * kTurbidity, kTurbidity, 1};
  double sum = 0;
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const auto& t = terms[i];
    sum += turbidity[i] * (((t[0] * sun_rad + t[1]) * sun_rad + t[2]) * sun_rad + t[3]);
  }
  return sum;
}

/// Linear sRGB of CIE xyY.
Array3d linear_rgb(double x, double y, double luminance) {
  const double big_x = x / y * luminance;
  const double big_z = (1 - x - y) / y * luminance;
  return Array3d(3.2406 * big_x - 1.5372 * luminance - 0.4986 * big_z,
                 -0.9689 * big_x + 1.8758 * luminance + 0.0415 * big_z,
                 0.0557 * big_x - 0.2040 * luminance + 1.0570 * big_z)
      .max(0.0);
}

class ClearSky {
 public:
  explicit ClearSky(const Vector3d& sun) : sun_(sun) {
    const double zenith_rad = std::acos(std::clamp(sun.z(), 0.0, 1.0));
    x_zenith_ = zenith_chromaticity({{{0.00166, -0.00375, 0.00209, 0},
                                      {-0.02903, 0.06377, -0.03202, 0.00394},
                                      {0.11693, -0.21196, 0.06052, 0.25886}}},
                                    zenith_rad);
    y_zenith_ = zenith_chromaticity({{{0.00275, -0.00610, 0.00317, 0},
                                      {-0.04214, 0.08970, -0.04153, 0.00516},
                                      {0.15346, -0.26756, 0.06670, 0.26688}}},
                                    zenith_rad);
  }

  Array3d radiance(const Vector3d& direction) const {
    const double gamma = std::acos(std::clamp(direction.dot(sun_), -1.0, 1.0));
    const auto relative = [&](const std::array<double, 5>& c) {
      return perez(c, direction.z(), gamma) /
             perez(c, 1, std::acos(std::clamp(sun_.z(), 0.0, 1.0)));
    };
    return linear_rgb(x_zenith_ * relative(x_), y_zenith_ * relative(y_), relative(luminance_));
  }

 private:
  Vector3d sun_;
  double x_zenith_ = 0;
  double y_zenith_ = 0;
  std::array<double, 5> luminance_ = linear({{{0.1787, -1.4630},
                                              {-0.3554, 0.4275},
                                              {-0.0227, 5.3251},
                                              {0.1206, -2.5771},
                                              {-0.0670, 0.3703}}});
  std::array<double, 5> x_ = linear({{{-0.0193, -0.2592},
                                      {-0.0665, 0.0008},
                                      {-0.0004, 0.2125},
                                      {-0.0641, -0.8989},
                                      {-0.0033, 0.0452}}});
  std::array<double, 5> y_ = linear({{{-0.0167, -0.2608},
                                      {-0.0950, 0.0092},
                                      {-0.0079, 0.2102},
                                      {-0.0441, -1.6537},
                                      {-0.0109, 0.0529}}});
};

Vector3d sky_direction(int row, int column) {
  const double sine = (row + 0.5) / kRows;
  const double azimuth = 2 * std::numbers::pi * (column + 0.5) / kColumns;
  const double level = std::sqrt(1 - sine * sine);
  return {level * std::cos(azimuth), level * std::sin(azimuth), sine};
}

/// Relative radiance in a direction.
Array3d relative_radiance(const Environment& environment, const Daylight& day,
                          const Vector3d& direction) {
  if (day.soft) {
    // The terms of (1 + 2 sin h) / 3 bring 3/7 and 4/7 of the light on level ground; 0.3 of the
    // whole is the soft light from above that Daylight::sun holds.
    constexpr double kEven = 3.0 / 7;
    constexpr double kWithSine = 4.0 / 7 - kSoftShare;
    return Array3d::Constant(kEven + 1.5 * kWithSine * direction.z());
  }
  // Town glow and fog come from everywhere alike.
  constexpr double kNightRad = -8 * kDegree;
  if (environment.weather != Weather::clear || environment.sun_elevation_rad <= kNightRad)
    return Array3d::Ones();
  return ClearSky(day.direction).radiance(direction);
}

}  // namespace

SkyLight::SkyLight(const Environment& environment, const Daylight& day)
    : table_(static_cast<std::size_t>(kRows * kColumns)) {
  Array3d received = Array3d::Zero();
  double weight = 0;
  std::vector<Array3d> relative;
  relative.reserve(table_.size());
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      const Vector3d direction = sky_direction(row, column);
      relative.push_back(relative_radiance(environment, day, direction));
      received += direction.z() * relative.back();
      weight += direction.z();
    }
  }
  const Array3d scale = day.sky / day.exposure / (received / weight).max(1e-9);
  for (std::size_t i = 0; i < table_.size(); ++i) table_[i] = (scale * relative[i]).cast<float>();
}

const Eigen::Array3f& SkyLight::radiance(const Eigen::Vector3f& direction) const {
  const int row = std::clamp(static_cast<int>(direction.z() * kRows), 0, kRows - 1);
  const float turn = std::atan2(direction.y(), direction.x()) / (2 * std::numbers::pi_v<float>);
  const int column =
      std::clamp(static_cast<int>((turn - std::floor(turn)) * kColumns), 0, kColumns - 1);
  return table_[static_cast<std::size_t>(row) * kColumns + static_cast<std::size_t>(column)];
}

}  // namespace throng::render
