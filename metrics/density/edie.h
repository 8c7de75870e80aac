// Density, flow and speed of people in a region of space and time (Edie, Proc. 2nd Int. Symp. on
// the Theory of Traffic Flow, 1963).
#pragma once

#include <Eigen/Core>

#include "metrics/basis/control_zone.h"

namespace throng::metrics {

/// Sums over a control zone and the added times. Paths are linear between steps; their parts in the
/// zone are exact.
class EdieRegion {
 public:
  /// Adds a time interval of this duration. Call it before add_walk() for the people in the
  /// interval.
  void add_time(const ControlZone& zone, double duration_s);
  /// Adds a person who walked from `from` to `to` (m) in the last interval.
  void add_walk(const ControlZone& zone, const Eigen::Vector2d& from, const Eigen::Vector2d& to);

  double duration_s() const { return duration_s_; }
  /// Total time of people in the region over area times duration (1/m²).
  double density_per_m2() const;
  /// Total distance of people in the region over area times duration (1/(m s)).
  double flow_per_ms() const;
  /// Total distance over total time (m/s); 0 without people.
  double speed_mps() const;

 private:
  double step_s_ = 0;
  double duration_s_ = 0;
  double area_m2_ = 0;
  double person_s_ = 0;
  double walked_m_ = 0;
};

}  // namespace throng::metrics
