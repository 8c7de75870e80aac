// The max crowd pressure on the ground.
#pragma once

#include <Eigen/Core>
#include <deque>
#include <span>
#include <utility>
#include <vector>

#include "metrics/basis/lattice.h"
#include "world/scenario.h"

namespace throng::metrics {

/// The pressure of pressure_at(), averaged over the last second, on a lattice over a region with a
/// pitch of 0.5 m, or coarser to limit it to 250 000 points. Points outside of the region and those
/// that buildings cover are skipped.
class GroundPressure {
 public:
  GroundPressure(const geometry::Region& ground, std::span<const world::Building> buildings,
                 double dt_s);

  /// Adds a person of the current step (m, m/s).
  void add(const Eigen::Vector2d& place, const Eigen::Vector2d& velocity);
  /// Ends a step and returns the max of the means (1/s²). During the first second, the mean is over
  /// the steps so far.
  double finish_step();
  /// After finish_step(): the mean (1/s²) at the lattice point nearest to `place`; 0 outside of the
  /// rectangle.
  double mean_at(const Eigen::Vector2d& place) const;

 private:
  /// Sums over the people near a lattice point, weighted by the kernel.
  struct Sums {
    double weight = 0;
    double x = 0, y = 0;  ///< velocity
    double squares = 0;   ///< squared speed
    double mean = 0;      ///< sum of the pressures of the last second
  };

  Lattice lattice_;
  std::vector<bool> covered_;  ///< per lattice point
  std::vector<Sums> sums_;     ///< per lattice point
  std::size_t window_;
  std::vector<std::size_t> touched_;  ///< lattice points near people of this step
  std::deque<std::vector<std::pair<std::size_t, double>>> last_;  ///< per step, nonzero values
};

}  // namespace throng::metrics
