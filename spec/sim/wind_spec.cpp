#include "spec/sim/wind_spec.h"

#include <algorithm>
#include <cmath>

namespace throng::sim {

using Eigen::Vector3d;

namespace {

constexpr double kReferenceHeightM = 10;

}  // namespace

Vector3d WindSpec::mean_at(double height_m) const {
  if (speed_mps == 0) return Vector3d::Zero();
  double factor = 1;
  if (profile == WindProfile::log_law) {
    const double from_z0 = std::max(height_m, roughness_m) / roughness_m;
    factor = std::log(from_z0) / std::log(kReferenceHeightM / roughness_m);
  } else if (profile == WindProfile::power_law) {
    factor = std::pow(std::max(height_m, 0.0) / kReferenceHeightM, exponent);
  }
  return factor * speed_mps * Vector3d(std::cos(direction_rad), std::sin(direction_rad), 0);
}

}  // namespace throng::sim
