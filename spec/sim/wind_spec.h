// The wind of a run: its mean as a function of height, and the model of its gusts.
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace throng::sim {

/// Mean wind as a function of the height z (m above the ground).
enum class WindProfile : std::uint8_t {
  uniform,    ///< constant
  log_law,    ///< proportional to ln(z / z0), z0 being the roughness length; calm below z0
  power_law,  ///< proportional to z^exponent
};

/// Models of gusts.
enum class GustModel : std::uint8_t {
  none,
  dryden,  ///< MIL-F-8785C (1980), low altitude: intensity and length scale by wind and height
  ou,      ///< Ornstein-Uhlenbeck process along each axis
};

/// Parameters of the wind; those that the chosen models do not use are ignored.
struct WindSpec {
  double speed_mps = 0;      ///< mean at 10 m above the ground
  double direction_rad = 0;  ///< direction toward which it blows, counter-clockwise from +x
  WindProfile profile = WindProfile::log_law;
  double roughness_m = 0.4;  ///< z0 of log_law: 0.03 grass, 0.4 suburbs, 1 and more city
  double exponent = 0.25;    ///< exponent of power_law
  GustModel gusts = GustModel::dryden;
  double intensity = 1;    ///< dryden: factor on the standard's intensity
  double gust_mps = 1.5;   ///< ou: standard deviation along each axis
  double gust_time_s = 3;  ///< ou: correlation time

  /// Mean wind at a height above the ground, m/s in the world's frame.
  Eigen::Vector3d mean_at(double height_m) const;
};

}  // namespace throng::sim
