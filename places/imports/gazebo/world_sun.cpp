#include "places/imports/gazebo/world_sun.h"

#include <algorithm>
#include <cmath>

#include "base/geometry/angle.h"
#include "spec/job/environment.h"

namespace throng::imports {

std::optional<ImportedSun> sun_like(const Eigen::Vector3d& towards_light, double latitude_deg) {
  constexpr double kLowest = 0.05;  // of the direction's z: 3 degrees
  constexpr int kDays = 365;
  constexpr int kTimesPerHour = 12;
  if (!(towards_light.norm() > 0)) return std::nullopt;
  const Eigen::Vector3d wanted = towards_light.normalized();
  if (!(wanted.z() > kLowest)) return std::nullopt;
  ImportedSun best;
  best.latitude_deg = latitude_deg;
  double best_cosine = -1;
  for (int day = 1; day <= kDays; ++day) {
    for (int time = 0; time < 24 * kTimesPerHour; ++time) {
      const double hours = static_cast<double>(time) / kTimesPerHour;
      const jobs::Sun sun = jobs::sun_at(hours, latitude_deg, day);
      const double level = std::cos(sun.elevation_rad);
      const Eigen::Vector3d towards_sun(level * std::cos(sun.azimuth_rad),
                                        level * std::sin(sun.azimuth_rad),
                                        std::sin(sun.elevation_rad));
      const double cosine = towards_sun.dot(wanted);
      if (cosine <= best_cosine + 1e-9) continue;
      best_cosine = cosine;
      best.day_of_year = day;
      best.time_of_day_h = hours;
    }
  }
  best.error_rad = std::acos(std::clamp(best_cosine, -1.0, 1.0));
  return best;
}

}  // namespace throng::imports
