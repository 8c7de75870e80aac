// The greatest crowd pressure anywhere on the ground.
#pragma once

#include <Eigen/Core>
#include <deque>
#include <span>
#include <utility>
#include <vector>

#include "metrics/basis/lattice.h"
#include "world/scenario.h"

namespace throng::metrics {

/// Pressure as pressure_at() has it, averaged over the last second, on a lattice over a rectangle:
/// every 0.5 m, or coarser where that would be more than 250 000 places. Places that buildings
/// cover have none.
class GroundPressure {
 public:
  GroundPressure(const world::Rectangle& ground, std::span<const world::Building> buildings,
                 double dt_s);

  /// Somebody of this step.
  void add(const Eigen::Vector2d& place, const Eigen::Vector2d& velocity);
  /// The greatest mean once everybody of a step was added (1/s²). In the first second the mean is
  /// over what there was.
  double finish_step();
  /// After finish_step(): the mean at the place of the lattice that is nearest to a point (1/s²).
  /// 0 outside of the rectangle.
  double mean_at(const Eigen::Vector2d& place) const;

 private:
  /// Sums over the people near a place of the lattice, each weighted by the kernel.
  struct Sums {
    double weight = 0;
    double x = 0, y = 0;  ///< velocity
    double squares = 0;   ///< of the velocity
    double mean = 0;      ///< pressures of the last second, summed
  };

  Lattice lattice_;
  std::vector<bool> covered_;  ///< per place
  std::vector<Sums> sums_;     ///< per place
  std::size_t window_;
  std::vector<std::size_t> touched_;  ///< places near somebody of this step
  std::deque<std::vector<std::pair<std::size_t, double>>> last_;  ///< per step, where it was not 0
};

}  // namespace throng::metrics
