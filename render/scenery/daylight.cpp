#include "render/scenery/daylight.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/geometry/angle.h"
#include "base/geometry/smoothstep.h"

namespace throng::render {

namespace {

using Eigen::Array3d;

constexpr double kMinShadowRad = 0.05;
constexpr double kTownGlow = 1e-4;  // the darkest sky, as a share of a high sun's

Array3d mixed(const Array3d& a, const Array3d& b, double share) {
  return a * (1 - share) + b * share;
}

/// The clear sky's light on level ground as a share of a high sun's. Above 10 degrees a straight
/// line, a quarter of the sun's light at 45 degrees as in the air of most days; below, the
/// logarithm of the illuminances of sunset and twilight (about 600, 50 and 3.4 lux at 0, -3 and -6
/// degrees: Seidelmann (ed.), Explanatory Supplement to the Astronomical Almanac, 1992, table of
/// ground illumination), down to the glow of a town.
double sky_strength(double elevation_rad) {
  const double degrees = elevation_rad / kDegree;
  if (degrees >= 10) return 0.41 + 0.34 * std::sin(elevation_rad);
  constexpr std::array<std::array<double, 2>, 6> kTable = {
      {{-8, kTownGlow}, {-6, 2.4e-4}, {-3, 2.3e-3}, {0, 0.028}, {5, 0.26}, {10, 0.4690}}};
  if (degrees <= kTable.front()[0]) return kTable.front()[1];
  std::size_t i = 0;
  while (degrees > kTable[i + 1][0]) ++i;
  const auto [x0, y0] = kTable[i];
  const auto [x1, y1] = kTable[i + 1];
  const double share = (degrees - x0) / (x1 - x0);
  return y0 * std::pow(y1 / y0, share);
}

/// The sky's hue by the sun's elevation: bluer in twilight, when ozone colors it.
Array3d sky_hue(double elevation_rad) {
  const double degrees = elevation_rad / kDegree;
  const Array3d day(0.34, 0.395, 0.475);
  const Array3d twilight(0.27, 0.37, 0.60);
  return mixed(twilight, day, geometry::smoothstep(-4, 8, degrees));
}

/// A lower sun shines through more air: weaker and warmer (optical depths for clear air).
Array3d clear_sun(double elevation_rad) {
  const double sine = std::sin(std::max(elevation_rad, kMinShadowRad));
  const Array3d through_air = (-Array3d(0.08, 0.14, 0.24) / (sine + 0.05)).exp();
  return 1.85 * through_air * geometry::smoothstep(-0.8 * kDegree, 2 * kDegree, elevation_rad);
}

/// Share of a clear sky's light that reaches level ground under this weather's clouds. A closed
/// cover lets a quarter through: 1 - 0.75 n^3.4 for n = 1 (Kasten and Czeplak 1980).
double cloud_share(Weather weather) {
  switch (weather) {
    case Weather::overcast:
      return 0.25;
    case Weather::rain:
      return 0.16;
    case Weather::fog:
      return 0.4;
    case Weather::clear:
      break;
  }
  return 1;
}

/// Exposure for a mean illuminance: the camera opens up as it gets darker, as automatic exposure
/// does, but only in part. Below daylight it follows more closely, or nights would be black.
double exposure_for(double mean) {
  constexpr double kNoonIlluminance = 1.7;
  constexpr double kDusk = 0.02;
  const double bright = std::max(mean, kDusk);
  const double seen = bright * std::pow(kNoonIlluminance / bright, 0.85);
  return seen * std::pow(std::min(mean / kDusk, 1.0), 0.06) / mean;
}

/// The camera meters the light of a fog too, and closes: images of fog are gray, not white.
double closed_for_fog(const Environment& environment, double extinction_per_m) {
  constexpr double kMeteredM = 40;  // what a drone looks at is about that far away
  constexpr double kAirShare = 0.35;
  if (environment.weather != Weather::fog) return 1;
  return 1 / (1 + kAirShare * (1 - std::exp(-extinction_per_m * kMeteredM)));
}

/// Sun and clouds' light before exposure.
void light_up(const Environment& environment, Daylight& light) {
  const double elevation = environment.sun_elevation_rad;
  const double shown = std::max(elevation, kMinShadowRad);
  light.direction = {std::cos(shown) * std::cos(environment.sun_azimuth_rad),
                     std::cos(shown) * std::sin(environment.sun_azimuth_rad), std::sin(shown)};
  light.sun = clear_sun(elevation);
  light.sky = sky_hue(elevation) * sky_strength(elevation);
  if (environment.weather == Weather::clear) {
    light.dark = light.sun.maxCoeff() <= 0;
    return;
  }
  const double level = (light.sun * light.direction.z() + light.sky).mean();
  // Only a thin fog lets some of the sun through: Beer's law in a layer of 100 m.
  constexpr double kFogDepthM = 100;
  const double direct = environment.weather == Weather::fog
                            ? std::exp(-light.extinction_per_m * kFogDepthM / light.direction.z())
                            : 0.0;
  const Array3d gray(0.96, 1.0, 1.05);
  // Clouds give a town its own light back.
  const double diffuse =
      std::max(cloud_share(environment.weather) * level, kTownGlow * sky_hue(elevation).mean());
  if (direct > 0.1) {
    light.sun *= direct;
    light.sky = gray * diffuse;
    light.dark = light.sun.maxCoeff() <= 0;
    return;
  }
  // The zenith of a gray sky is three times as bright as its horizon (Moon and Spencer 1942): a
  // part of that excess is a soft light from above, in which people have shadows.
  light.soft = true;
  light.direction = Eigen::Vector3d::UnitZ();
  light.sun = kSoftShare * diffuse * gray;
  light.sky = (1 - kSoftShare) * diffuse * gray;
}

void color_the_air(const Environment& environment, Daylight& light) {
  const double degrees = environment.sun_elevation_rad / kDegree;
  // Bright as the sky's light is, compared with an afternoon's.
  const double received = (light.sky + light.sun * (light.soft ? 1 : 0)).mean();
  if (environment.weather != Weather::clear) {
    constexpr double kAfternoon = 0.366;
    const double level = std::min(received / kAfternoon, 1.3);
    light.haze = Array3d(0.60, 0.62, 0.64) * level;
    light.zenith = Array3d(0.56, 0.58, 0.61) * level;
    if (environment.weather == Weather::rain) light.zenith *= 0.8;
    // Inside a fog the air is as bright as a white surface in it.
    if (environment.weather == Weather::fog) light.haze *= kAfternoon / 0.60;
    return;
  }
  const double setting =
      geometry::smoothstep(-5, 0.5, degrees) * (1 - geometry::smoothstep(3, 14, degrees));
  constexpr double kClearAfternoon = 0.265;  // exposed light of the sky that has these colors
  // A setting sun's sky keeps its color below the film's white.
  const double level = std::min(received / kClearAfternoon, 1.3 - 0.4 * setting);
  const Array3d day(0.62, 0.70, 0.80);
  light.haze =
      mixed(day, Array3d(0.95, 0.62, 0.40), 0.75 * setting) * std::max(level, 0.5 * setting);
  light.zenith = mixed(Array3d(0.17, 0.30, 0.55), Array3d(0.22, 0.30, 0.48), setting) * level;
}

}  // namespace

Daylight daylight(const Environment& environment) {
  constexpr double kVisibleContrast = 3.912;  // -ln 0.02 (Koschmieder 1924)
  constexpr double kLampMean = 1.6e-4;        // 9 lux
  // Without shadows more of an image is as bright as its light, and the camera, which meters the
  // image, closes.
  constexpr double kDiffuse = 0.8;
  Daylight light;
  light.extinction_per_m = kVisibleContrast / environment.visibility_m;
  light.lamps_on = environment.sun_elevation_rad < 0;
  light_up(environment, light);
  const double lamp_mean = light.lamps_on ? kLampMean : 0;
  constexpr double kUnitLux = 54000;
  const double mean = (light.sun * light.direction.z() + light.sky).mean() + lamp_mean;
  light.illuminance_lux = mean * kUnitLux;
  const double exposure = exposure_for(mean) * (light.soft ? kDiffuse : 1) *
                          closed_for_fog(environment, light.extinction_per_m);
  light.exposure = exposure;
  if (light.soft) light.film_black = 0.02;
  light.sun *= exposure;
  light.sky *= exposure;
  // Warm white, half of which the white balance takes back.
  if (light.lamps_on) light.lamps = Array3d(1.16, 0.98, 0.74) * exposure;
  color_the_air(environment, light);
  return light;
}

}  // namespace throng::render
