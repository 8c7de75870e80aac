#include "imports/free_ground.h"

#include <algorithm>
#include <cmath>

#include "world/polygon.h"

namespace throng::imports {

using Eigen::Vector2d;

namespace {

constexpr int kUnseen = -2;
constexpr double kBodyM = 0.35;

std::size_t cells_along(double length_m) {
  return static_cast<std::size_t>(std::max(1.0, std::ceil(length_m / FreeGround::kCellM)));
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
  return area_.min + kCellM * Vector2d(static_cast<double>(cell % columns_) + 0.5,
                                       static_cast<double>(cell / columns_) + 0.5);
}

void FreeGround::block(const Corners& obstacle) {
  Vector2d low = obstacle.front();
  Vector2d high = low;
  for (const Vector2d& corner : obstacle) {
    low = low.cwiseMin(corner);
    high = high.cwiseMax(corner);
  }
  const auto cell_of = [&](double metres, double from, std::size_t count) {
    const double cell = std::floor((metres - from) / kCellM);
    return static_cast<std::size_t>(std::clamp(cell, 0.0, static_cast<double>(count)));
  };
  const std::size_t last_column = cell_of(high.x() + kBodyM + kCellM, area_.min.x(), columns_);
  const std::size_t last_row = cell_of(high.y() + kBodyM + kCellM, area_.min.y(), rows_);
  for (std::size_t row = cell_of(low.y() - kBodyM, area_.min.y(), rows_); row < last_row; ++row) {
    for (std::size_t column = cell_of(low.x() - kBodyM, area_.min.x(), columns_);
         column < last_column; ++column) {
      const std::size_t cell = row * columns_ + column;
      if (world::distance_to(obstacle, middle_of(cell)) < kBodyM) region_[cell] = kBlocked;
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

std::vector<Vector2d> FreeGround::cells_of(int region) const {
  std::vector<Vector2d> cells;
  for (std::size_t cell = 0; cell < region_.size(); ++cell) {
    if (region_[cell] == region) cells.push_back(middle_of(cell));
  }
  return cells;
}

}  // namespace throng::imports
