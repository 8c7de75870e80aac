// Crowd pressure: density times the variance of velocity (Helbing, Johansson and Al-Abideen, Phys.
// Rev. E 75, 046109, 2007).
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "base/geometry/point_grid.h"
#include "metrics/basis/control_zone.h"
#include "metrics/basis/near_people.h"

namespace throng::metrics {

/// Distance at which the Gaussian kernel exp(-r²/R²) / (pi R²) of density and velocity has fallen
/// to 1/e. People beyond twice of it are left out, and the kernel made up for it.
inline constexpr double kPressureRadiusM = 1.0;
inline constexpr double kPressureReachM = 2 * kPressureRadiusM;

/// Pressure (1/s²) from sums over the people within reach, each times exp(-r²/R²): of 1, of the
/// velocity and of its square. 0 where nobody is.
double crowd_pressure(double weights, const Eigen::Vector2d& velocities, double squares);

/// Pressure at one place and instant (1/s²). `grid` holds the places of `people`, in that order.
double pressure_at(const Eigen::Vector2d& place, const geometry::PointGrid& grid,
                   std::span<const NearPerson> people);

/// Pressure in a control zone, on a lattice of 0.5 m, averaged over the last second.
class PressureMeter {
 public:
  PressureMeter(const ControlZone& zone, double dt_s);

  /// The greatest average over the lattice after one more step (1/s²). Causal: less than a second
  /// after the start, the average is over what there was.
  double step(std::span<const NearPerson> people);

 private:
  std::vector<Eigen::Vector2d> lattice_;
  std::size_t window_;
  std::size_t steps_ = 0;
  std::vector<std::vector<double>> last_;  ///< per step of the window, round and round
  std::vector<double> sum_;
};

}  // namespace throng::metrics
