#include "crowd/navigation/walkable_mesh.h"

#include <Recast.h>
#include <RecastAlloc.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "base/error.h"
#include "base/geometry/polygon.h"
#include "crowd/navigation/walkable_grid.h"

namespace throng::crowd {

namespace {

constexpr int kMaxCorners = 6;  // of a polygon

template <typename Part, void (*kFree)(Part*)>
struct Free {
  void operator()(Part* part) const { kFree(part); }
};
using Field =
    std::unique_ptr<rcCompactHeightfield, Free<rcCompactHeightfield, rcFreeCompactHeightfield>>;
using Contours = std::unique_ptr<rcContourSet, Free<rcContourSet, rcFreeContourSet>>;
using Polygons = std::unique_ptr<rcPolyMesh, Free<rcPolyMesh, rcFreePolyMesh>>;

template <typename Value>
Value* allocate(std::size_t count) {
  // Recast frees its arrays itself.
  auto* values =
      static_cast<Value*>(rcAlloc(std::max<std::size_t>(count, 1) * sizeof(Value), RC_ALLOC_PERM));
  if (values == nullptr) throw EnvironmentError("not enough memory for a navigation mesh");
  std::uninitialized_value_construct_n(values, count);
  return values;
}

/// The grid as Recast's flat ground: one span in every cell where one can walk.
Field make_field(const WalkableGrid& grid) {
  Field field(rcAllocCompactHeightfield());
  field->width = grid.columns;
  field->height = grid.rows;
  field->spanCount =
      static_cast<int>(std::count(grid.walkable.begin(), grid.walkable.end(), std::uint8_t{1}));
  field->walkableHeight = 1;
  field->walkableClimb = 1;
  field->cs = grid.cell_m;
  field->ch = 1;
  field->bmax[0] = grid.cell_m * static_cast<float>(grid.columns);
  field->bmax[2] = grid.cell_m * static_cast<float>(grid.rows);
  const auto spans = static_cast<std::size_t>(field->spanCount);
  field->cells = allocate<rcCompactCell>(grid.walkable.size());
  field->spans = allocate<rcCompactSpan>(spans);
  field->areas = allocate<unsigned char>(spans);
  unsigned next = 0;
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      const std::size_t cell = grid.index(column, row);
      field->cells[cell].index = next;
      field->cells[cell].count = grid.walkable[cell];
      if (grid.walkable[cell] == 0) continue;
      rcCompactSpan& span = field->spans[next];
      span.h = 255;
      field->areas[next++] = RC_WALKABLE_AREA;
      for (int side = 0; side < 4; ++side) {
        const int x = column + rcGetDirOffsetX(side);
        const int y = row + rcGetDirOffsetY(side);
        const bool inside = x >= 0 && x < grid.columns && y >= 0 && y < grid.rows;
        const bool open = inside && grid.walkable[grid.index(x, y)] != 0;
        rcSetCon(span, side, open ? 0 : RC_NOT_CONNECTED);
      }
    }
  }
  return field;
}

/// Convex polygons over the walkable cells; null when there are more than Recast can count.
Polygons make_polygons(const WalkableGrid& grid, float radius) {
  rcContext quiet(false);
  const Field field = make_field(grid);
  const float cells = 2 * radius / grid.cell_m;
  constexpr int kMergeBelow = 400;  // cells; small neighbors become one
  constexpr float kCoarsest = 1;    // how far outlines may be off, in cells
  Contours contours(rcAllocContourSet());
  Polygons polygons(rcAllocPolyMesh());
  const bool done =
      rcBuildDistanceField(&quiet, *field) &&
      rcBuildRegions(&quiet, *field, 0, static_cast<int>(cells * cells), kMergeBelow) &&
      rcBuildContours(&quiet, *field, kCoarsest, 0, *contours, 0) &&
      rcBuildPolyMesh(&quiet, *contours, kMaxCorners, *polygons);
  if (!done) polygons.reset();
  return polygons;
}

/// Adds a rectangle beside the grid, so that the mesh goes on there.
int add_rectangle(const Box& box, std::vector<NavPolygon>& mesh) {
  NavPolygon polygon;
  polygon.corners = {box.min, {box.max.x(), box.min.y()}, box.max, {box.min.x(), box.max.y()}};
  polygon.center = box.center();
  mesh.push_back(std::move(polygon));
  return static_cast<int>(mesh.size()) - 1;
}

void add_portal(int from, int to, const Eigen::Vector2f& a, const Eigen::Vector2f& b,
                std::vector<NavPolygon>& mesh) {
  const Eigen::Vector2f& center = mesh[static_cast<std::size_t>(from)].center;
  const bool a_is_left = geometry::cross(b - center, a - center) > 0;
  mesh[static_cast<std::size_t>(from)].portals.push_back(
      {to, a_is_left ? a : b, a_is_left ? b : a});
}

void connect(int one, int other, const Eigen::Vector2f& a, const Eigen::Vector2f& b,
             std::vector<NavPolygon>& mesh) {
  add_portal(one, other, a, b, mesh);
  add_portal(other, one, a, b, mesh);
}

/// The open ground around the grid, in eight rectangles: [column][row], the middle one being the
/// grid itself.
using CellBlock = std::array<std::array<int, 3>, 3>;

CellBlock add_surroundings(const Box& inner, const Box& outer, std::vector<NavPolygon>& mesh) {
  const std::array<float, 4> x = {outer.min.x(), inner.min.x(), inner.max.x(), outer.max.x()};
  const std::array<float, 4> y = {outer.min.y(), inner.min.y(), inner.max.y(), outer.max.y()};
  CellBlock around{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const bool is_grid = i == 1 && j == 1;
      around[i][j] = is_grid ? -1 : add_rectangle({{x[i], y[j]}, {x[i + 1], y[j + 1]}}, mesh);
    }
  }
  const auto join = [&](int one, int other, const Eigen::Vector2f& a, const Eigen::Vector2f& b) {
    if (one >= 0 && other >= 0) connect(one, other, a, b, mesh);
  };
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 2; ++j) {
      join(around[j][i], around[j + 1][i], {x[j + 1], y[i]}, {x[j + 1], y[i + 1]});
      join(around[i][j], around[i][j + 1], {x[i], y[j + 1]}, {x[i + 1], y[j + 1]});
    }
  }
  return around;
}

/// The rectangle beside the grid that an edge of the grid's polygons lies on; -1 if on none.
int beside(const CellBlock& around, const WalkableGrid& grid, const unsigned short* a,
           const unsigned short* b) {
  if (a[0] == 0 && b[0] == 0) return around[0][1];
  if (a[0] == grid.columns && b[0] == grid.columns) return around[2][1];
  if (a[2] == 0 && b[2] == 0) return around[1][0];
  if (a[2] == grid.rows && b[2] == grid.rows) return around[1][2];
  return -1;
}

NavMesh join_polygons(const rcPolyMesh& polygons, const WalkableGrid& grid, const Box& outer) {
  std::vector<NavPolygon> mesh(static_cast<std::size_t>(polygons.npolys));
  const CellBlock around = add_surroundings(grid.box, outer, mesh);
  for (int i = 0; i < polygons.npolys; ++i) {
    const unsigned short* corners = polygons.polys + std::ptrdiff_t{2} * kMaxCorners * i;
    const unsigned short* neighbors = corners + kMaxCorners;
    int count = 0;
    while (count < kMaxCorners && corners[count] != RC_MESH_NULL_IDX) ++count;
    const auto raw = [&](int corner) {
      return polygons.verts + std::ptrdiff_t{3} * corners[corner % count];
    };
    const auto place = [&](int corner) {
      return Eigen::Vector2f(grid.box.min +
                             grid.cell_m * Eigen::Vector2f(static_cast<float>(raw(corner)[0]),
                                                           static_cast<float>(raw(corner)[2])));
    };
    NavPolygon& polygon = mesh[static_cast<std::size_t>(i)];
    float area = 0;
    for (int c = 0; c < count; ++c) {
      polygon.corners.push_back(place(c));
      polygon.center += place(c) / static_cast<float>(count);
      area += geometry::cross(place(c) - place(0), place(c + 1) - place(0));
    }
    if (area < 0) std::reverse(polygon.corners.begin(), polygon.corners.end());
    for (int c = 0; c < count; ++c) {
      if (neighbors[c] != RC_MESH_NULL_IDX) {
        add_portal(i, neighbors[c], place(c), place(c + 1), mesh);
      } else if (const int out = beside(around, grid, raw(c), raw(c + 1)); out >= 0) {
        connect(i, out, place(c), place(c + 1), mesh);
      }
    }
  }
  return NavMesh(std::move(mesh));
}

}  // namespace

NavMesh make_walkable_mesh(const Obstacles& obstacles, std::uint32_t class_mask, float radius,
                           const Box& everyone, const WalkableMeshOptions& options) {
  Box box;
  bool any = false;
  for (const Segment& wall : obstacles.segments()) {
    if ((wall.obstacle_class & class_mask) == 0) continue;
    if (!any) box = {wall.begin, wall.begin};
    any = true;
    box.extend(wall.begin);
  }
  if (!any) return NavMesh(std::vector<NavPolygon>());

  constexpr float kMaxCells = 4e6F;
  constexpr float kMaxSide = 6e4F;  // cells; Recast counts in 16 bits
  float cell = options.cell_m.value_or(radius / 3);
  for (;;) {
    // A wall without thickness has to block a row of cells all along, even a slanting one.
    const float clearance = std::max(radius - 0.5F * cell, 0.75F * cell);
    const float margin = options.margin_m + radius + 2 * cell;
    const Box grown{box.min.array() - margin, box.max.array() + margin};
    const Eigen::Vector2f size = grown.max - grown.min;
    const float fewest =
        std::max(std::sqrt(size.x() * size.y() / kMaxCells), size.maxCoeff() / kMaxSide);
    if (cell < fewest) {
      cell = 1.01F * fewest;
      continue;
    }
    const WalkableGrid grid = mark_walkable(obstacles, class_mask, grown, cell, clearance);
    if (std::find(grid.walkable.begin(), grid.walkable.end(), 1) == grid.walkable.end()) {
      return NavMesh(std::vector<NavPolygon>());
    }
    const Polygons polygons = make_polygons(grid, radius);
    constexpr float kAround = 300;  // m
    if (polygons) {
      return join_polygons(*polygons, grid,
                           {grid.box.min.cwiseMin(everyone.min).array() - kAround,
                            grid.box.max.cwiseMax(everyone.max).array() + kAround});
    }
    cell *= 2;
    if (cell > size.maxCoeff()) return NavMesh(std::vector<NavPolygon>());
  }
}

}  // namespace throng::crowd
