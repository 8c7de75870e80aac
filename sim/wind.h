// Wind: a mean that grows with height, and gusts that each craft meets on its own.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "base/random.h"

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

/// The gusts that one craft meets. Made on a grid of 60 per second and linear in between, so that
/// they do not depend on how often they are asked for.
class Gusts {
 public:
  /// `craft` numbers the crafts of a run; each has gusts of its own.
  Gusts(const WindSpec& spec, std::uint64_t seed, std::uint64_t craft);

  /// Gust velocity in the world. Times must not decrease. The air's speed relative to the craft and
  /// its height are those that the next grid points are made with.
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
