#include "places/standing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "world/polygon.h"

namespace throng::places {

using Eigen::Vector2d;

namespace {

constexpr double kNearestM = 0.45;  // between the middles of two people
constexpr double kSparsestM = 40;

world::Rectangle bounds_of(std::span<const Vector2d> outline) {
  world::Rectangle bounds{outline.front(), outline.front()};
  for (const Vector2d& corner : outline) {
    bounds.min = bounds.min.cwiseMin(corner);
    bounds.max = bounds.max.cwiseMax(corner);
  }
  return bounds;
}

std::vector<Vector2d> outline_of(const world::Prop& prop) {
  // Nothing thinner than this: a wall of no width is none.
  constexpr double kThinnestM = 0.1;
  const Vector2d half =
      (prop.scale * world::prop_types().at(static_cast<std::size_t>(prop.kind)).half_size)
          .cwiseMax(kThinnestM);
  const Vector2d along(std::cos(prop.yaw_rad), std::sin(prop.yaw_rad));
  const Vector2d across(-along.y(), along.x());
  const auto corner = [&](double x, double y) -> Vector2d {
    return prop.position + x * half.x() * along + y * half.y() * across;
  };
  return {corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)};
}

/// Rows of free places, one below the other, joined where they are alike.
std::vector<PlaceGrid> fill(std::span<const Vector2d> area, double apart_m, const Solids& solids,
                            double clearance_m) {
  const world::Rectangle bounds = bounds_of(area);
  std::vector<PlaceGrid> grids;
  const int rows = 1 + static_cast<int>((bounds.max.y() - bounds.min.y()) / apart_m);
  const int columns = 1 + static_cast<int>((bounds.max.x() - bounds.min.x()) / apart_m);
  for (int row = 0; row < rows; ++row) {
    const std::size_t row_begin = grids.size();
    std::optional<PlaceGrid> run;
    for (int column = 0; column <= columns; ++column) {
      const Vector2d at = bounds.min + apart_m * Vector2d(column, row);
      const bool free =
          column < columns && world::distance_to(area, at) == 0 && solids.is_clear(at, clearance_m);
      if (free && run) ++run->columns;
      if (free && !run) run = PlaceGrid{at, apart_m, 1, 1};
      if (free || !run) continue;
      const auto row_end = grids.begin() + static_cast<std::ptrdiff_t>(row_begin);
      const auto alike = std::find_if(grids.begin(), row_end, [&](const PlaceGrid& above) {
        const double next_y = above.first.y() + above.rows * apart_m;
        return above.first.x() == run->first.x() && above.columns == run->columns &&
               std::abs(next_y - run->first.y()) < 0.5 * apart_m;
      });
      if (alike != row_end) {
        ++alike->rows;
      } else {
        grids.push_back(*run);
      }
      run.reset();
    }
  }
  return grids;
}

int count_of(const std::vector<PlaceGrid>& grids) {
  int count = 0;
  for (const PlaceGrid& grid : grids) count += grid.count();
  return count;
}

/// Takes away what is too much, from the end.
void cut(int count, std::vector<PlaceGrid>& grids) {
  int surplus = count_of(grids) - count;
  while (surplus > 0) {
    PlaceGrid& last = grids.back();
    if (last.count() <= surplus) {
      surplus -= last.count();
      grids.pop_back();
    } else if (last.rows == 1) {
      last.columns -= surplus;
      surplus = 0;
    } else if (last.columns <= surplus) {
      surplus -= last.columns;
      --last.rows;
    } else {
      PlaceGrid top = last;
      --last.rows;
      top.first.y() += last.rows * top.apart_m;
      top.rows = 1;
      grids.push_back(top);
    }
  }
}

}  // namespace

Solids::Solids(const world::Scenario& scenario) {
  for (const world::Building& building : scenario.buildings) {
    outlines_.push_back(building.footprint);
  }
  for (const world::Prop& prop : scenario.props) outlines_.push_back(outline_of(prop));
  for (const auto& outline : outlines_) bounds_.push_back(bounds_of(outline));
}

bool Solids::is_clear(const Vector2d& point, double clearance_m) const {
  const Eigen::Array2d near = point.array();
  for (std::size_t i = 0; i < outlines_.size(); ++i) {
    if ((near < bounds_[i].min.array() - clearance_m).any() ||
        (near > bounds_[i].max.array() + clearance_m).any()) {
      continue;
    }
    if (world::distance_to(outlines_[i], point) < clearance_m) return false;
  }
  return true;
}

std::vector<PlaceGrid> spread(std::span<const Vector2d> area, int count, const Solids& solids,
                              double clearance_m) {
  constexpr double kCloser = 0.97;
  double apart_m =
      std::clamp(std::sqrt(std::abs(world::signed_area(area)) / count), kNearestM, kSparsestM);
  while (true) {
    std::vector<PlaceGrid> grids = fill(area, apart_m, solids, clearance_m);
    if (count_of(grids) >= count) {
      cut(count, grids);
      return grids;
    }
    if (apart_m <= kNearestM) return grids;
    apart_m = std::max(kNearestM, kCloser * apart_m);
  }
}

}  // namespace throng::places
