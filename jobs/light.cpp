#include "jobs/light.h"

#include <cmath>
#include <numbers>

#include "base/angle.h"

namespace throng::jobs {

namespace {

constexpr double kLatitude = 45 * kDegree;
constexpr double kDeclination = 15 * kDegree;
constexpr double kTurnPerHour = 15 * kDegree;
constexpr double kLowestUsefulSun = 5 * kDegree;

}  // namespace

render::Lighting sun_at(double time_of_day_h) {
  const double hour_angle = (time_of_day_h - 12) * kTurnPerHour;
  // The direction to the sun: east, north, up.
  const double east = -std::cos(kDeclination) * std::sin(hour_angle);
  const double north = std::cos(kLatitude) * std::sin(kDeclination) -
                       std::sin(kLatitude) * std::cos(kDeclination) * std::cos(hour_angle);
  const double up = std::sin(kLatitude) * std::sin(kDeclination) +
                    std::cos(kLatitude) * std::cos(kDeclination) * std::cos(hour_angle);
  render::Lighting light;
  light.sun_azimuth_rad = std::atan2(north, east);
  light.sun_elevation_rad = std::asin(up);
  return light;
}

bool sun_is_up(double time_of_day_h) {
  return sun_at(time_of_day_h).sun_elevation_rad >= kLowestUsefulSun;
}

}  // namespace throng::jobs
