#include "formats/recording/geodetic_fix.h"

#include <algorithm>
#include <cmath>

#include "base/geometry/angle.h"

namespace throng::formats::ros {

Fix geodetic_fix(const Eigen::Vector3d& position, double latitude_deg,
                 const Eigen::Vector3d& sd_m) {
  constexpr double kEquatorM = 6'378'137;
  constexpr double kEccentricity2 = 6.69437999014e-3;
  const double sine = std::sin(latitude_deg * kDegree);
  const double share = 1 - kEccentricity2 * sine * sine;
  const double east_radius_m = kEquatorM / std::sqrt(share);
  const double north_radius_m = east_radius_m * (1 - kEccentricity2) / share;
  const double cosine = std::max(std::cos(latitude_deg * kDegree), 1e-9);
  return {latitude_deg + position.y() / north_radius_m / kDegree,
          position.x() / (east_radius_m * cosine) / kDegree, position.z(), sd_m};
}

}  // namespace throng::formats::ros
