// Density, flow and speed of people in a region of space and time (Edie, Proc. 2nd Int. Symp. on
// the Theory of Traffic Flow, 1963).
#pragma once

#include <Eigen/Core>

#include "metrics/basis/control_zone.h"

namespace throng::metrics {

/// Sums over a control zone and the times that were added. People walk straight from step to step;
/// what of that lies in the zone is exact.
class EdieRegion {
 public:
  /// For so long the zone is looked at (s): before the people of that time.
  void add_time(const ControlZone& zone, double duration_s);
  /// Somebody who walked from `from` to `to` in that time.
  void add_walk(const ControlZone& zone, const Eigen::Vector2d& from, const Eigen::Vector2d& to);

  double duration_s() const { return duration_s_; }
  /// Time that people spent in the region over its area and duration (1/m²).
  double density_per_m2() const;
  /// Distance that people walked in it over its area and duration (1/(m s)).
  double flow_per_ms() const;
  /// Distance over time (m/s); 0 where nobody was.
  double speed_mps() const;

 private:
  double step_s_ = 0;
  double duration_s_ = 0;
  double area_m2_ = 0;
  double person_s_ = 0;
  double walked_m_ = 0;
};

}  // namespace throng::metrics
