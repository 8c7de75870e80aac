#include "metrics/basis/lattice.h"

#include <algorithm>
#include <cmath>

#include "base/geometry/polygon.h"
#include "base/geometry/rectangle.h"

namespace throng::metrics {

using Eigen::Vector2d;

Lattice lattice_over(const world::Rectangle& ground, double pitch_m, double max_points) {
  const Vector2d size = (ground.max - ground.min).cwiseMax(0);
  Lattice lattice;
  lattice.pitch_m = std::max(pitch_m, std::sqrt(size.prod() / max_points));
  lattice.first = ground.min + Vector2d::Constant(0.5 * lattice.pitch_m);
  lattice.columns = static_cast<int>(std::ceil(size.x() / lattice.pitch_m));
  lattice.rows = static_cast<int>(std::ceil(size.y() / lattice.pitch_m));
  return lattice;
}

std::vector<bool> covered_by(std::span<const world::Building> buildings, const Lattice& lattice) {
  std::vector<bool> covered(lattice.size(), false);
  const auto cell_of = [&](double offset_m, int count) {
    return static_cast<int>(std::clamp(std::floor(offset_m / lattice.pitch_m), -1.0, 1.0 * count));
  };
  for (const world::Building& building : buildings) {
    auto [min, max] = geometry::bounding_box(building.footprint);
    min -= lattice.first;
    max -= lattice.first;
    const int last_row = std::min(lattice.rows - 1, cell_of(max.y(), lattice.rows) + 1);
    const int last_column = std::min(lattice.columns - 1, cell_of(max.x(), lattice.columns) + 1);
    for (int row = std::max(0, cell_of(min.y(), lattice.rows)); row <= last_row; ++row) {
      for (int column = std::max(0, cell_of(min.x(), lattice.columns)); column <= last_column;
           ++column) {
        if (geometry::distance_to(building.footprint, lattice.place(column, row)) <= 0) {
          covered[lattice.index(column, row)] = true;
        }
      }
    }
  }
  return covered;
}

}  // namespace throng::metrics
