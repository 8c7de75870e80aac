// Wind as a run has it: a mean that grows with height, and the kind of its gusts.
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace throng::sim {

/// How the mean wind changes with height z (m above the ground).
enum class WindProfile : std::uint8_t {
  uniform,    ///< not at all
  log_law,    ///< as ln(z / z0), z0 being the ground's roughness; calm below z0
  power_law,  ///< as z to the exponent
};

/// How gusts are made.
enum class GustModel : std::uint8_t {
  none,
  dryden,  ///< MIL-F-8785C (1980), low altitude: strength and size follow from wind and height
  ou,      ///< Ornstein-Uhlenbeck along each axis, of a given strength and duration
};

struct WindSpec {
  double speed_mps = 0;      ///< mean at 10 m above the ground
  double direction_rad = 0;  ///< where the wind blows to, counter-clockwise from +x
  WindProfile profile = WindProfile::log_law;
  double roughness_m = 0.4;  ///< z0 of log_law: 0.03 grass, 0.4 suburbs, 1 and more city
  double exponent = 0.25;    ///< of power_law
  GustModel gusts = GustModel::dryden;
  double intensity = 1;    ///< dryden: factor on the standard's strength
  double gust_mps = 1.5;   ///< ou: standard deviation along each axis
  double gust_time_s = 3;  ///< ou: correlation time

  /// Mean wind at a height, m/s in the world.
  Eigen::Vector3d mean_at(double height_m) const;
};

}  // namespace throng::sim
