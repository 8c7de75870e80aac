#include "spec/sun/sun.h"

#include <algorithm>
#include <cmath>

#include "base/geometry/angle.h"

namespace throng::jobs {

Sun sun_at(double time_of_day_h, double latitude_deg, int day_of_year) {
  constexpr int kDaysPerYear = 365;
  constexpr double kNoonH = 12;
  constexpr double kTurnPerHour = 15 * kDegree;
  const double day = 360 * kDegree * (day_of_year - 1) / kDaysPerYear;
  const double declination = 0.006918 - 0.399912 * std::cos(day) + 0.070257 * std::sin(day) -
                             0.006758 * std::cos(2 * day) + 0.000907 * std::sin(2 * day) -
                             0.002697 * std::cos(3 * day) + 0.00148 * std::sin(3 * day);
  const double latitude = latitude_deg * kDegree;
  const double hour_angle = (time_of_day_h - kNoonH) * kTurnPerHour;
  const double east = -std::cos(declination) * std::sin(hour_angle);
  const double north = std::cos(latitude) * std::sin(declination) -
                       std::sin(latitude) * std::cos(declination) * std::cos(hour_angle);
  const double up = std::sin(latitude) * std::sin(declination) +
                    std::cos(latitude) * std::cos(declination) * std::cos(hour_angle);
  return {std::atan2(north, east), std::asin(std::clamp(up, -1.0, 1.0))};
}

}  // namespace throng::jobs
