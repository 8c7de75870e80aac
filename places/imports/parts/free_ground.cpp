#include "places/imports/parts/free_ground.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/geometry/polygon.h"
#include "base/geometry/rectangle.h"

namespace throng::imports {

using Eigen::Vector2d;

namespace {

constexpr int kUnseen = -2;
constexpr double kBodyM = 0.35;

std::size_t cells_along(double length_m) {
  return static_cast<std::size_t>(std::max(1.0, std::ceil(length_m / FreeGround::kCellM)));
}

// The cell of a point along one axis; `count` for what is beyond.
std::size_t cell_at(double meters, std::size_t count) {
  const double cell = std::floor(meters / FreeGround::kCellM);
  return static_cast<std::size_t>(std::clamp(cell, 0.0, static_cast<double>(count)));
}

// Range of x that an edge can be near enough to, in a row at y.
std::pair<double, double> reach_in_band(const Vector2d& a, const Vector2d& b, double y) {
  const double rise = b.y() - a.y();
  double from = 0;
  double to = 1;
  if (std::abs(rise) > 1e-9) {
    const double low = (y - kBodyM - a.y()) / rise;
    const double high = (y + kBodyM - a.y()) / rise;
    from = std::clamp(std::min(low, high), 0.0, 1.0);
    to = std::clamp(std::max(low, high), 0.0, 1.0);
  }
  const double x1 = a.x() + from * (b.x() - a.x());
  const double x2 = a.x() + to * (b.x() - a.x());
  return {std::min(x1, x2) - kBodyM, std::max(x1, x2) + kBodyM};
}

}  // namespace

FreeGround::FreeGround(const world::Rectangle& area, const std::vector<Corners>& obstacles)
    : area_(area),
      columns_(cells_along(area.max.x() - area.min.x())),
      rows_(cells_along(area.max.y() - area.min.y())),
      region_(columns_ * rows_, kUnseen) {
  for (const Corners& obstacle : obstacles) block(obstacle);
  for (std::size_t cell = 0; cell < region_.size(); ++cell) {
    if (region_[cell] == kUnseen) flood(cell);
  }
}

Vector2d FreeGround::middle_of(std::size_t cell) const {
  const std::size_t row = cell / columns_;
  return area_.min + kCellM * Vector2d(static_cast<double>(cell % columns_) + 0.5,
                                       static_cast<double>(row) + 0.5);
}

// Row by row, so that a lake of a thousand corners costs its cells and its shore, not both
// multiplied.
void FreeGround::block(const Corners& obstacle) {
  const auto row_of = [&](double y) { return cell_at(y - area_.min.y(), rows_); };
  const auto column_of = [&](double x) { return cell_at(x - area_.min.x(), columns_); };
  const geometry::Rectangle bounds = geometry::bounding_box(obstacle);
  const std::size_t first = row_of(bounds.min.y());
  const std::size_t last = row_of(bounds.max.y() + kCellM);
  std::vector<std::vector<double>> crossings(last - first);
  for (std::size_t i = 0; i < obstacle.size(); ++i) {
    const Vector2d& a = obstacle[i];
    const Vector2d& b = obstacle[(i + 1) % obstacle.size()];
    const double low = std::min(a.y(), b.y());
    const double high = std::max(a.y(), b.y());
    for (std::size_t row = row_of(low - kBodyM); row < row_of(high + kBodyM + kCellM); ++row) {
      const double y = middle_of(row * columns_).y();
      if (row >= first && row < last && y >= low && y < high) {
        crossings[row - first].push_back(a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
      }
      const auto [from, to] = reach_in_band(a, b, y);
      for (std::size_t column = column_of(from); column < column_of(to + kCellM); ++column) {
        const std::size_t cell = row * columns_ + column;
        if (geometry::distance_to_segment(a, b, middle_of(cell)) < kBodyM) region_[cell] = kBlocked;
      }
    }
  }
  for (std::size_t row = first; row < last; ++row) {
    std::vector<double>& xs = crossings[row - first];
    std::sort(xs.begin(), xs.end());
    for (std::size_t i = 0; i + 1 < xs.size(); i += 2) {
      for (std::size_t column = column_of(xs[i]); column < column_of(xs[i + 1] + kCellM);
           ++column) {
        const std::size_t cell = row * columns_ + column;
        const double x = middle_of(cell).x();
        if (x >= xs[i] && x <= xs[i + 1]) region_[cell] = kBlocked;
      }
    }
  }
}

void FreeGround::flood(std::size_t from) {
  const int region = static_cast<int>(sizes_.size());
  sizes_.push_back(0);
  std::vector<std::size_t> edge = {from};
  region_[from] = region;
  const auto visit = [&](std::size_t cell) {
    if (region_[cell] != kUnseen) return;
    region_[cell] = region;
    edge.push_back(cell);
  };
  while (!edge.empty()) {
    const std::size_t cell = edge.back();
    edge.pop_back();
    ++sizes_.back();
    const std::size_t column = cell % columns_;
    if (column > 0) visit(cell - 1);
    if (column + 1 < columns_) visit(cell + 1);
    if (cell >= columns_) visit(cell - columns_);
    if (cell + columns_ < region_.size()) visit(cell + columns_);
  }
}

int FreeGround::region_at(const Vector2d& point) const {
  if (!area_.contains(point)) return kBlocked;
  const Vector2d at = (point - area_.min) / kCellM;
  const auto column = std::min(static_cast<std::size_t>(at.x()), columns_ - 1);
  const auto row = std::min(static_cast<std::size_t>(at.y()), rows_ - 1);
  return region_[row * columns_ + column];
}

std::vector<Vector2d> FreeGround::cells_in_region(int region) const {
  std::vector<Vector2d> cells;
  for (std::size_t cell = 0; cell < region_.size(); ++cell) {
    if (region_[cell] == region) cells.push_back(middle_of(cell));
  }
  return cells;
}

}  // namespace throng::imports
