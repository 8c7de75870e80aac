#include "metrics/walking_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "world/polygon.h"

namespace throng::metrics {

using Eigen::Vector2d;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kFinestM = 0.25;
constexpr double kMostCells = 1e6;
constexpr double kSameM = 1e-9;

double distance_to_segment(const Vector2d& point, const Vector2d& from, const Vector2d& to) {
  const Vector2d along = to - from;
  const double share = std::clamp((point - from).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (point - from - share * along).norm();
}

}  // namespace

WalkingDistance::WalkingDistance(const world::Rectangle& ground,
                                 const std::vector<world::Building>& buildings,
                                 const world::Exit& door)
    : origin_(ground.min) {
  const Vector2d size = ground.max - ground.min;
  cell_m_ = std::max(kFinestM, std::sqrt(size.prod() / kMostCells));
  columns_ = static_cast<int>(std::ceil(size.x() / cell_m_));
  rows_ = static_cast<int>(std::ceil(size.y() / cell_m_));
  const auto cells = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
  blocked_.assign(cells, false);
  distance_m_.assign(cells, kInfinity);
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      const Vector2d place = centre(column, row);
      blocked_[index(column, row)] =
          std::any_of(buildings.begin(), buildings.end(), [&](const world::Building& building) {
            return world::distance_to(building.footprint, place) <= 0;
          });
      const double to_door = distance_to_segment(place, door.from, door.to);
      if (to_door <= cell_m_ && !blocked_[index(column, row)]) at(column, row) = to_door;
    }
  }
  for (bool changes = true; changes;) {
    changes = false;
    for (const bool left : {false, true}) {
      for (const bool down : {false, true}) changes = sweep(left, down) || changes;
    }
  }
}

bool WalkingDistance::sweep(bool left, bool down) {
  bool changes = false;
  for (int i = 0; i < rows_; ++i) {
    const int row = down ? rows_ - 1 - i : i;
    for (int j = 0; j < columns_; ++j) {
      changes = update(left ? columns_ - 1 - j : j, row) || changes;
    }
  }
  return changes;
}

// Godunov's upwind difference of |grad d| = 1.
bool WalkingDistance::update(int column, int row) {
  if (blocked_[index(column, row)]) return false;
  const auto known = [&](int c, int r) {
    return c < 0 || r < 0 || c >= columns_ || r >= rows_ ? kInfinity : at(c, r);
  };
  const double a = std::min(known(column - 1, row), known(column + 1, row));
  const double b = std::min(known(column, row - 1), known(column, row + 1));
  if (std::min(a, b) == kInfinity) return false;
  double length = std::min(a, b) + cell_m_;
  if (std::abs(a - b) < cell_m_) {
    length = 0.5 * (a + b + std::sqrt(2 * cell_m_ * cell_m_ - (a - b) * (a - b)));
  }
  if (length >= at(column, row) - kSameM) return false;
  at(column, row) = length;
  return true;
}

std::optional<double> WalkingDistance::from(const Vector2d& place) const {
  const Vector2d cell = (place - origin_) / cell_m_ - Vector2d(0.5, 0.5);
  const int column = static_cast<int>(std::floor(cell.x()));
  const int row = static_cast<int>(std::floor(cell.y()));
  double sum = 0;
  double weights = 0;
  for (const int c : {column, column + 1}) {
    for (const int r : {row, row + 1}) {
      if (c < 0 || r < 0 || c >= columns_ || r >= rows_) continue;
      const double length = distance_m_[index(c, r)];
      const double weight = (1 - std::abs(cell.x() - c)) * (1 - std::abs(cell.y() - r));
      if (length == kInfinity || weight <= 0) continue;
      sum += weight * length;
      weights += weight;
    }
  }
  if (weights <= 0) return std::nullopt;
  return sum / weights;
}

}  // namespace throng::metrics
