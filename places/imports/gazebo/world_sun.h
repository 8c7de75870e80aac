// The sun of a job whose light comes from where a world's directional light does.
#pragma once

#include <Eigen/Core>
#include <optional>

namespace throng::imports {

/// A time and place of which the sun stands somewhere.
struct ImportedSun {
  double latitude_deg = 0;
  int day_of_year = 1;
  double time_of_day_h = 12;  ///< solar time
  double error_rad = 0;       ///< angle between this sun and the light
};

/// The day and time at which the sun at this latitude is nearest to `towards_light` (+y is north).
/// The first of several days that fit equally well counts. Nothing for a light from below 3
/// degrees.
std::optional<ImportedSun> sun_like(const Eigen::Vector3d& towards_light, double latitude_deg);

}  // namespace throng::imports
