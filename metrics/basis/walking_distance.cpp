#include "metrics/basis/walking_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/geometry/polygon.h"

namespace throng::metrics {

using Eigen::Vector2d;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kFinestM = 0.25;
constexpr double kMaxCells = 1e6;
constexpr double kSameM = 1e-9;

}  // namespace

WalkingDistance::WalkingDistance(const world::Rectangle& ground,
                                 const std::vector<world::Building>& buildings,
                                 const world::Exit& door)
    : door_from_(door.from),
      door_to_(door.to),
      lattice_(lattice_over(ground, kFinestM, kMaxCells)),
      blocked_(covered_by(buildings, lattice_)),
      distance_m_(lattice_.size(), kInfinity) {
  footprints_.reserve(buildings.size());
  for (const world::Building& building : buildings) footprints_.push_back(building.footprint);
  for (int row = 0; row < lattice_.rows; ++row) {
    for (int column = 0; column < lattice_.columns; ++column) {
      const Vector2d place = lattice_.place(column, row);
      const double to_door =
          (place - geometry::nearest_on_segment(door_from_, door_to_, place)).norm();
      if (to_door <= lattice_.pitch_m && !blocked_[lattice_.index(column, row)]) {
        at(column, row) = to_door;
      }
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
  for (int i = 0; i < lattice_.rows; ++i) {
    const int row = down ? lattice_.rows - 1 - i : i;
    for (int j = 0; j < lattice_.columns; ++j) {
      changes = update(left ? lattice_.columns - 1 - j : j, row) || changes;
    }
  }
  return changes;
}

// Godunov's upwind difference of |grad d| = 1.
bool WalkingDistance::update(int column, int row) {
  if (blocked_[lattice_.index(column, row)]) return false;
  const auto known = [&](int c, int r) {
    return c < 0 || r < 0 || c >= lattice_.columns || r >= lattice_.rows ? kInfinity : at(c, r);
  };
  const double a = std::min(known(column - 1, row), known(column + 1, row));
  const double b = std::min(known(column, row - 1), known(column, row + 1));
  if (std::min(a, b) == kInfinity) return false;
  double length = std::min(a, b) + lattice_.pitch_m;
  if (std::abs(a - b) < lattice_.pitch_m) {
    length = 0.5 * (a + b + std::sqrt(2 * lattice_.pitch_m * lattice_.pitch_m - (a - b) * (a - b)));
  }
  if (length >= at(column, row) - kSameM) return false;
  at(column, row) = length;
  return true;
}

std::optional<double> WalkingDistance::from(const Vector2d& place) const {
  const Vector2d cell = (place - lattice_.first) / lattice_.pitch_m;
  const int column = static_cast<int>(std::floor(cell.x()));
  const int row = static_cast<int>(std::floor(cell.y()));
  double sum = 0;
  double weights = 0;
  for (const int c : {column, column + 1}) {
    for (const int r : {row, row + 1}) {
      if (c < 0 || r < 0 || c >= lattice_.columns || r >= lattice_.rows) continue;
      const double length = distance_m_[lattice_.index(c, r)];
      const double weight = (1 - std::abs(cell.x() - c)) * (1 - std::abs(cell.y() - r));
      if (length == kInfinity || weight <= 0) continue;
      sum += weight * length;
      weights += weight;
    }
  }
  if (weights <= 0) return std::nullopt;
  const Vector2d door = geometry::nearest_on_segment(door_from_, door_to_, place);
  return straight_path_is_free(place, door) ? (place - door).norm() : sum / weights;
}

bool WalkingDistance::straight_path_is_free(const Vector2d& from, const Vector2d& to) const {
  return std::none_of(footprints_.begin(), footprints_.end(), [&](const auto& footprint) {
    if (crosses_outline(footprint, from, to)) return true;
    // Exactly through two corners it crosses no edge.
    return geometry::distance_to(footprint, 0.5 * (from + to)) <= 0;
  });
}

bool crosses_outline(const std::vector<Vector2d>& corners, const Vector2d& from,
                     const Vector2d& to) {
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector2d& next = corners[i + 1 < corners.size() ? i + 1 : 0];
    if (geometry::segments_cross(from, to, corners[i], next)) return true;
  }
  return false;
}

std::vector<WalkingDistance> walking_distances(const world::Scenario& scenario) {
  world::Rectangle ground = scenario.inside.bounds;
  for (const world::Exit& exit : scenario.exits) {
    ground.extend(exit.from);
    ground.extend(exit.to);
  }
  std::vector<WalkingDistance> distances;
  distances.reserve(scenario.exits.size());
  for (const world::Exit& exit : scenario.exits) {
    distances.emplace_back(ground, scenario.buildings, exit);
  }
  return distances;
}

}  // namespace throng::metrics
