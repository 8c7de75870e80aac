#include "crowd/navigation/walkable_grid.h"

#include <algorithm>
#include <cmath>

#include "base/geometry/polygon.h"

namespace throng::crowd {

namespace {

/// The columns whose centers lie between two x, within the grid.
struct Columns {
  int begin = 0;
  int end = 0;
};

Columns columns_between(const WalkableGrid& grid, float low_x, float high_x) {
  const auto column = [&](float x) {
    const float at = (x - grid.box.min.x()) / grid.cell_m - 0.5F;
    return static_cast<int>(std::ceil(std::clamp(at, -1.0F, static_cast<float>(grid.columns))));
  };
  return {std::max(0, column(low_x)), std::min(grid.columns, column(high_x) + 1)};
}

/// The last row whose center is not above y; -1 when all are.
int row_below(const WalkableGrid& grid, float y) {
  const float at = (y - grid.box.min.y()) / grid.cell_m - 0.5F;
  return static_cast<int>(std::floor(std::clamp(at, -1.0F, static_cast<float>(grid.rows))));
}

void block_beside_wall(const Segment& wall, float clearance, WalkableGrid& grid) {
  const Eigen::Vector2f& low = wall.begin.y() <= wall.end.y() ? wall.begin : wall.end;
  const Eigen::Vector2f& high = wall.begin.y() <= wall.end.y() ? wall.end : wall.begin;
  const int first = std::max(0, row_below(grid, low.y() - clearance));
  const int last = std::min(grid.rows - 1, row_below(grid, high.y() + clearance) + 1);
  for (int row = first; row <= last; ++row) {
    // Only the part of the wall that is near this row matters.
    const float y = grid.center(0, row).y();
    const float height = high.y() - low.y();
    const auto x_at = [&](float at_y) {
      const float t = height > 0 ? std::clamp((at_y - low.y()) / height, 0.0F, 1.0F) : 0;
      return low.x() + t * (high.x() - low.x());
    };
    const float a = height > 0 ? x_at(y - clearance) : low.x();
    const float b = height > 0 ? x_at(y + clearance) : high.x();
    const Columns columns =
        columns_between(grid, std::min(a, b) - clearance, std::max(a, b) + clearance);
    for (int column = columns.begin; column < columns.end; ++column) {
      const Eigen::Vector2f center = grid.center(column, row);
      const float distance_sq =
          (geometry::nearest_on_segment(wall.begin, wall.end, center) - center).squaredNorm();
      if (distance_sq < clearance * clearance) grid.walkable[grid.index(column, row)] = 0;
    }
  }
}

void block_inside(const Obstacles& obstacles, const Polygon& polygon, WalkableGrid& grid) {
  float low_y = obstacles.segments()[polygon.first].begin.y();
  float high_y = low_y;
  for (int i = polygon.first; i < polygon.first + polygon.count; ++i) {
    low_y = std::min(low_y, obstacles.segments()[i].begin.y());
    high_y = std::max(high_y, obstacles.segments()[i].begin.y());
  }
  std::vector<float> crossings;
  const int first = std::max(0, row_below(grid, low_y));
  const int last = std::min(grid.rows - 1, row_below(grid, high_y) + 1);
  for (int row = first; row <= last; ++row) {
    const float y = grid.center(0, row).y();
    crossings.clear();
    for (int i = polygon.first; i < polygon.first + polygon.count; ++i) {
      const Eigen::Vector2f& a = obstacles.segments()[i].begin;
      const Eigen::Vector2f& b = obstacles.segments()[i].end;
      if ((a.y() > y) == (b.y() > y)) continue;
      crossings.push_back(a.x() + (b.x() - a.x()) * (y - a.y()) / (b.y() - a.y()));
    }
    std::sort(crossings.begin(), crossings.end());
    for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
      const Columns columns = columns_between(grid, crossings[i], crossings[i + 1]);
      for (int column = columns.begin; column < columns.end; ++column) {
        const float x = grid.center(column, row).x();
        if (x >= crossings[i] && x <= crossings[i + 1]) {
          grid.walkable[grid.index(column, row)] = 0;
        }
      }
    }
  }
}

}  // namespace

WalkableGrid mark_walkable(const Obstacles& obstacles, std::uint32_t class_mask, const Box& box,
                           float cell_m, float clearance) {
  WalkableGrid grid;
  grid.cell_m = cell_m;
  const Eigen::Vector2f size = box.max - box.min;
  grid.columns = static_cast<int>(std::ceil(size.x() / cell_m));
  grid.rows = static_cast<int>(std::ceil(size.y() / cell_m));
  grid.box.min = box.min;
  grid.box.max = box.min + cell_m * Eigen::Vector2f(static_cast<float>(grid.columns),
                                                    static_cast<float>(grid.rows));
  grid.walkable.assign(grid.index(0, grid.rows), 1);
  for (const Polygon& polygon : obstacles.polygons()) {
    if ((polygon.obstacle_class & class_mask) == 0) continue;
    if (polygon.solid) block_inside(obstacles, polygon, grid);
    for (int i = polygon.first; i < polygon.first + polygon.count; ++i) {
      block_beside_wall(obstacles.segments()[i], clearance, grid);
    }
  }
  return grid;
}

}  // namespace throng::crowd
