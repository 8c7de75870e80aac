// The gusts that each vehicle meets on its own, on top of the mean wind (spec/sim/wind_spec.h).
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "base/compute/random.h"
#include "spec/sim/wind_spec.h"

namespace throng::sim {

/// The gusts that one vehicle meets. Made on a grid of 60 per second and linear in between, so that
/// they do not depend on how often they are asked for.
class Gusts {
 public:
  /// `craft` numbers the vehicles of a run; each has gusts of its own.
  Gusts(const WindSpec& spec, std::uint64_t seed, std::uint64_t vehicle);

  /// Gust velocity in the world. Times must not decrease. The air's speed relative to the vehicle
  /// and its height are those that the next grid points are made with.
  Eigen::Vector3d at(double time_s, double height_m, double airspeed_mps);

 private:
  /// Three-dimensional turbulence seen along a line through frozen air. Axes: along the mean wind,
  /// across it, up.
  Eigen::Vector3d next_point(double height_m, double airspeed_mps);
  Eigen::Vector3d dryden_point(double height_m, double airspeed_mps);
  Eigen::Vector3d ou_point();

  WindSpec spec_;
  double wind_at_20_ft_mps_;
  Random random_;
  Eigen::Vector3d first_;   ///< state of the filters' first lag, variance 1
  Eigen::Vector3d second_;  ///< of the second lag behind it
  long grid_ = 0;           ///< number of the point `after_`
  Eigen::Vector3d before_;
  Eigen::Vector3d after_;
};

}  // namespace throng::sim
