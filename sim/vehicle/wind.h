// Gusts at each vehicle, to be added to the mean wind (spec/sim/wind_spec.h).
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "base/compute/random.h"
#include "spec/sim/wind_spec.h"

namespace throng::sim {

/// The gusts at one vehicle: samples at 60 Hz with linear interpolation, so that they do not depend
/// on the times of the queries.
class Gusts {
 public:
  /// `vehicle`, the index of the vehicle in the run, makes the gusts of vehicles independent.
  Gusts(const WindSpec& spec, std::uint64_t seed, std::uint64_t vehicle);

  /// Gust velocity (m/s, world). Times must not decrease. The vehicle's height and airspeed are
  /// used for the samples that are computed in this call.
  Eigen::Vector3d at(double time_s, double height_m, double airspeed_mps);

 private:
  /// The next sample: turbulence along a line through a frozen field. Axes: along the mean wind,
  /// across it, up.
  Eigen::Vector3d next_point(double height_m, double airspeed_mps);
  Eigen::Vector3d dryden_point(double height_m, double airspeed_mps);
  Eigen::Vector3d ou_point();

  WindSpec spec_;
  double wind_at_20_ft_mps_;
  Random random_;
  Eigen::Vector3d first_;   ///< state of the filters' first lag, variance 1
  Eigen::Vector3d second_;  ///< state of the filters' second lag
  long grid_ = 0;           ///< index of the sample `after_`
  Eigen::Vector3d before_;
  Eigen::Vector3d after_;
};

}  // namespace throng::sim
