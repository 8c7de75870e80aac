// A grid for finding points near a position.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "base/geometry/rectangle.h"

namespace throng::geometry {

/// Points sorted by the square cells of a grid over their bounding box. Cells are enlarged if there
/// would be more than about four per point. Const member functions may be called from several
/// threads.
class PointGrid {
 public:
  /// Copies the points. `cell_m` is the min size of a cell.
  PointGrid(std::span<const Eigen::Vector2d> points, double cell_m)
      : points_(points.begin(), points.end()), cell_m_(cell_m) {
    if (points_.empty()) return;
    const Rectangle bounds = bounding_box(points_);
    min_ = bounds.min;
    const Eigen::Vector2d size = bounds.max - bounds.min;
    // A few distant points must not cost memory for all the ground in between.
    const double max_cells = 4.0 * static_cast<double>(points_.size()) + 64;
    while ((size.x() / cell_m_ + 1) * (size.y() / cell_m_ + 1) > max_cells) cell_m_ *= 1.5;
    columns_ = static_cast<int>(size.x() / cell_m_) + 1;
    rows_ = static_cast<int>(size.y() / cell_m_) + 1;
    fill();
  }

  double cell_m() const { return cell_m_; }
  std::size_t size() const { return points_.size(); }
  const Eigen::Vector2d& operator[](std::size_t index) const { return points_[index]; }

  /// Calls body(index, point) for all points of the cells at Chebyshev distance `ring` from the
  /// cell of `place`. The rings 0 to k contain all points within k * cell_m(). Returns false if the
  /// ring is outside the grid.
  template <typename Body>
  bool for_ring(const Eigen::Vector2d& place, int ring, const Body& body) const {
    const int column = cell_index(place.x() - min_.x());
    const int row = cell_index(place.y() - min_.y());
    if (column + ring >= columns_ && row + ring >= rows_ && column - ring < 0 && row - ring < 0) {
      return false;
    }
    for (int r = std::max(0, row - ring); r <= std::min(rows_ - 1, row + ring); ++r) {
      if (r == row - ring || r == row + ring) {
        visit(r, column - ring, column + ring, body);
      } else {
        visit(r, column - ring, column - ring, body);
        if (ring > 0) visit(r, column + ring, column + ring, body);
      }
    }
    return true;
  }

  /// Calls body(index, point) for every point within `radius_m` of `place`.
  template <typename Body>
  void for_within(const Eigen::Vector2d& place, double radius_m, const Body& body) const {
    for_stored_about(place, radius_m, [&](std::size_t slot, const Eigen::Vector2d& point) {
      if ((point - place).squaredNorm() <= radius_m * radius_m) body(sorted_[slot].index, point);
    });
  }

  /// Returns a point by its slot, 0 to size() - 1; near points have near slots.
  const Eigen::Vector2d& stored(std::size_t slot) const { return sorted_[slot].point; }

  /// Calls body(slot, point) for all points of the cells that overlap the square of half side
  /// `radius_m` around `place`.
  template <typename Body>
  void for_stored_about(const Eigen::Vector2d& place, double radius_m, const Body& body) const {
    const int low = std::max(0, cell_index(place.y() - radius_m - min_.y()));
    const int high = std::min(rows_ - 1, cell_index(place.y() + radius_m - min_.y()));
    const int from = cell_index(place.x() - radius_m - min_.x());
    const int to = cell_index(place.x() + radius_m - min_.x());
    for (int row = low; row <= high; ++row) {
      const auto [first, last] = slots_of(row, from, to);
      for (std::size_t slot = first; slot < last; ++slot) body(slot, sorted_[slot].point);
    }
  }

 private:
  /// Points in the order of their cells.
  struct Sorted {
    Eigen::Vector2d point;
    std::size_t index = 0;
  };

  int cell_index(double offset_m) const {
    constexpr double kFar = 1e6;  // cells; no point is farther away
    return static_cast<int>(std::clamp(std::floor(offset_m / cell_m_), -kFar, kFar));
  }

  std::size_t cell_of(const Eigen::Vector2d& point) const {
    const int column = std::clamp(cell_index(point.x() - min_.x()), 0, columns_ - 1);
    const int row = std::clamp(cell_index(point.y() - min_.y()), 0, rows_ - 1);
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }

  void fill() {
    start_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_) + 1, 0);
    for (const Eigen::Vector2d& point : points_) ++start_[cell_of(point) + 1];
    for (std::size_t i = 1; i < start_.size(); ++i) start_[i] += start_[i - 1];
    sorted_.resize(points_.size());
    std::vector<std::size_t> next(start_.begin(), start_.end() - 1);
    for (std::size_t i = 0; i < points_.size(); ++i) {
      sorted_[next[cell_of(points_[i])]++] = {points_[i], i};
    }
  }

  /// Range of the slots of a row's cells; empty if there are no such cells.
  std::pair<std::size_t, std::size_t> slots_of(int row, int from_column, int to_column) const {
    const int from = std::max(0, from_column);
    const int to = std::min(columns_ - 1, to_column);
    if (from > to) return {0, 0};
    const auto first = static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_);
    return {start_[first + static_cast<std::size_t>(from)],
            start_[first + static_cast<std::size_t>(to) + 1]};
  }

  template <typename Body>
  void visit(int row, int from_column, int to_column, const Body& body) const {
    const auto [first, last] = slots_of(row, from_column, to_column);
    for (std::size_t i = first; i < last; ++i) body(sorted_[i].index, sorted_[i].point);
  }

  std::vector<Eigen::Vector2d> points_;
  double cell_m_;
  Eigen::Vector2d min_ = Eigen::Vector2d::Zero();
  int columns_ = 0;
  int rows_ = 0;
  std::vector<std::size_t> start_;  ///< per cell: the first slot of its points
  std::vector<Sorted> sorted_;      ///< by cell, then by index
};

}  // namespace throng::geometry
