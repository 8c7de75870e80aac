#include "places/imports/parts/solids.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/geometry/polygon.h"
#include "base/geometry/rectangle.h"
#include "base/geometry/triangulate.h"

namespace throng::imports {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

constexpr int kRound = 24;

void add_quad(Triangles& triangles, const Vector3d& a, const Vector3d& b, const Vector3d& c,
              const Vector3d& d) {
  triangles.push_back({a, b, c});
  triangles.push_back({a, c, d});
}

// The part of a polygon on one side of a height.
std::vector<Vector3d> cut(const std::vector<Vector3d>& polygon, double z, double side) {
  return geometry::clipped(polygon, [&](const Vector3d& p) { return side * (z - p.z()); });
}

// Cells of the ground, marked where something is.
class Raster {
 public:
  Raster(const Vector2d& low, const Vector2d& high) : low_(low) {
    constexpr double kCell = 0.25;
    constexpr double kMaxCells = 1000;
    cell_ = std::max(kCell, (high - low).maxCoeff() / kMaxCells);
    columns_ = 1 + static_cast<int>((high.x() - low.x()) / cell_);
    rows_ = 1 + static_cast<int>((high.y() - low.y()) / cell_);
    marked_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), false);
  }

  void mark(const std::vector<Vector3d>& polygon) {
    std::vector<Vector2d> flat;
    flat.reserve(polygon.size());
    for (const Vector3d& p : polygon) flat.emplace_back(p.head<2>());
    const auto [low, high] = geometry::bounding_box(flat);
    for (int row = row_at(low.y()); row <= row_at(high.y()); ++row) {
      for (int column = column_at(low.x()); column <= column_at(high.x()); ++column) {
        const Vector2d middle = low_ + cell_ * Vector2d(column + 0.5, row + 0.5);
        // Upright faces on the line between two cells, as at both ends of the raster, count.
        constexpr double kRoundingM = 1e-6;
        if (geometry::distance_to(flat, middle) <= 0.5 * cell_ + kRoundingM) {
          marked_[at(column, row)] = true;
        }
      }
    }
  }

  // Takes rectangles off, each as wide and then as high as it can be.
  std::vector<Corners> rectangles() {
    std::vector<Corners> found;
    for (int row = 0; row < rows_; ++row) {
      for (int column = 0; column < columns_; ++column) {
        if (!marked_[at(column, row)]) continue;
        int end = column;
        while (end < columns_ && marked_[at(end, row)]) ++end;
        int top = row;
        while (top < rows_ && take(column, end, top)) ++top;
        found.push_back(rectangle_corners(
            {low_ + cell_ * Vector2d(column, row), low_ + cell_ * Vector2d(end, top)}));
      }
    }
    return found;
  }

 private:
  std::size_t at(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }
  int column_at(double x) const {
    return std::clamp(static_cast<int>((x - low_.x()) / cell_), 0, columns_ - 1);
  }
  int row_at(double y) const {
    return std::clamp(static_cast<int>((y - low_.y()) / cell_), 0, rows_ - 1);
  }
  bool take(int from, int end, int row) {
    for (int column = from; column < end; ++column) {
      if (!marked_[at(column, row)]) return false;
    }
    for (int column = from; column < end; ++column) marked_[at(column, row)] = false;
    return true;
  }

  Vector2d low_;
  double cell_ = 0;
  int columns_ = 0;
  int rows_ = 0;
  std::vector<bool> marked_;
};

}  // namespace

Triangles cone_triangles(double radius, double length) {
  const Corners base = circle(Vector2d::Zero(), radius);
  const Vector3d tip(0, 0, 0.5 * length);
  const Vector3d middle(0, 0, -0.5 * length);
  Triangles triangles;
  for (std::size_t i = 0; i < base.size(); ++i) {
    const Vector2d& next = base[(i + 1) % base.size()];
    const Vector3d a(base[i].x(), base[i].y(), middle.z());
    const Vector3d b(next.x(), next.y(), middle.z());
    triangles.push_back({a, b, tip});
    triangles.push_back({b, a, middle});
  }
  return triangles;
}

Triangles ball_triangles(const Vector3d& radii, double stretch) {
  constexpr int kRings = 12;
  const auto point_at = [&](int ring, int segment) -> Vector3d {
    const double up = std::numbers::pi * ring / kRings;
    const double around = 2 * std::numbers::pi * segment / kRound;
    const Vector3d unit(std::sin(up) * std::cos(around), std::sin(up) * std::sin(around),
                        std::cos(up));
    return unit.cwiseProduct(radii) + Vector3d(0, 0, (2 * ring < kRings ? 0.5 : -0.5) * stretch);
  };
  Triangles triangles;
  for (int ring = 0; ring < kRings; ++ring) {
    for (int segment = 0; segment < kRound; ++segment) {
      add_quad(triangles, point_at(ring, segment), point_at(ring + 1, segment),
               point_at(ring + 1, segment + 1), point_at(ring, segment + 1));
    }
  }
  return triangles;
}

Triangles prism_triangles(const Corners& footprint, double from_z, double to_z) {
  const auto at = [](const Vector2d& p, double z) { return Vector3d(p.x(), p.y(), z); };
  Triangles triangles;
  for (const auto& [a, b, c] : geometry::triangulate(footprint)) {
    triangles.push_back({at(footprint[a], to_z), at(footprint[b], to_z), at(footprint[c], to_z)});
    triangles.push_back(
        {at(footprint[a], from_z), at(footprint[c], from_z), at(footprint[b], from_z)});
  }
  for (std::size_t i = 0; i < footprint.size(); ++i) {
    const Vector2d& a = footprint[i];
    const Vector2d& b = footprint[(i + 1) % footprint.size()];
    add_quad(triangles, at(a, from_z), at(b, from_z), at(b, to_z), at(a, to_z));
  }
  return triangles;
}

void move(Triangles& triangles, const Eigen::Isometry3d& pose) {
  for (Triangle& triangle : triangles) {
    for (Vector3d& corner : triangle) corner = pose * corner;
  }
}

std::vector<Corners> project_shadow(const Triangles& triangles) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const Triangle& triangle : triangles) {
    for (const Vector3d& corner : triangle) lowest = std::min(lowest, corner.z());
  }
  if (is_overhead(lowest)) return {};
  std::vector<std::vector<Vector3d>> slices;
  for (const Triangle& triangle : triangles) {
    const std::vector<Vector3d> whole(triangle.begin(), triangle.end());
    std::vector<Vector3d> slice = cut(cut(whole, kStepM, 1), kHeadM, -1);
    // The top of a step is at kStepM at the most; the rest of it was cut off.
    const bool is_above =
        std::any_of(slice.begin(), slice.end(), [](const Vector3d& p) { return !is_step(p.z()); });
    if (slice.size() >= 2 && is_above) slices.push_back(std::move(slice));
  }
  if (slices.empty()) return {};
  Vector2d low = slices.front().front().head<2>();
  Vector2d high = low;
  for (const auto& slice : slices) {
    for (const Vector3d& p : slice) {
      low = low.cwiseMin(p.head<2>());
      high = high.cwiseMax(p.head<2>());
    }
  }
  Raster raster(low, high);
  for (const auto& slice : slices) raster.mark(slice);
  return raster.rectangles();
}

}  // namespace throng::imports
