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

/// Radius R of the Gaussian kernel exp(-r²/R²) / (pi R²) for density and velocity. The kernel is
/// truncated at kPressureReachM and normalized accordingly.
inline constexpr double kPressureRadiusM = 1.0;
inline constexpr double kPressureReachM = 2 * kPressureRadiusM;

/// Pressure (1/s²) from sums, weighted by exp(-r²/R²), over the people within kPressureReachM: of
/// 1, of the velocity and of the squared speed. 0 without people.
double crowd_pressure(double weights, const Eigen::Vector2d& velocities, double squares);

/// Pressure (1/s²) at a point. `grid` contains the positions of `people`, in the same order.
double pressure_at(const Eigen::Vector2d& place, const geometry::PointGrid& grid,
                   std::span<const NearPerson> people);

/// Measures the pressure in a control zone on a lattice with a pitch of 0.5 m, averaged over the
/// last second.
class PressureMeter {
 public:
  PressureMeter(const ControlZone& zone, double dt_s);

  /// Adds a step and returns the max average over the lattice (1/s²). During the first second, the
  /// average is over the steps so far.
  double step(std::span<const NearPerson> people);

 private:
  std::vector<Eigen::Vector2d> lattice_;
  std::size_t window_;
  std::size_t steps_ = 0;
  std::vector<std::vector<double>> last_;  ///< per step of the window, as a ring buffer
  std::vector<double> sum_;
};

}  // namespace throng::metrics
