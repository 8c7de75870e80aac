#include "render/ground/ground_builder.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/geometry/polygon.h"
#include "render/frame/frame.h"
#include "render/ground/ground_tone.h"

namespace throng::render {

using Eigen::Vector2d;
using Polygon = std::vector<Vector2d>;

namespace {

/// Sides of the cells that areas are cut into are at least this long.
constexpr double kMinCellM = 3;

}  // namespace

Polygon cut(const Polygon& polygon, const Vector2d& normal, double limit) {
  return geometry::clipped(polygon, [&](const Vector2d& p) { return normal.dot(p) - limit; });
}

std::vector<GroundSegment> in_pieces(const GroundSegment& segment) {
  constexpr double kPieceM = 2;
  const double count = std::max(1.0, std::ceil(segment.length_m() / kPieceM));
  const Vector2d step = (segment.to - segment.from) / count;
  std::vector<GroundSegment> pieces;
  for (double i = 0; i < count; ++i) {
    pieces.push_back({segment.from + i * step, segment.from + (i + 1) * step});
  }
  return pieces;
}

void GroundBuilder::set_outline(std::span<const Vector2d> outline) {
  Eigen::AlignedBox2d bounds;
  for (const Vector2d& p : outline) bounds.extend(p);
  const bool is_wide = !outline.empty() && bounds.sizes().minCoeff() > 3 * kMinCellM;
  outline_ = is_wide ? outline : std::span<const Vector2d>();
}

void GroundBuilder::add(Polygon polygon, double height_m) {
  if (polygon.size() < 3) return;
  // A fan around the innermost corner: no triangle has all of its corners on the outline.
  std::rotate(polygon.begin(),
              std::max_element(polygon.begin(), polygon.end(),
                               [&](const Vector2d& a, const Vector2d& b) {
                                 return inside_m(a) + 1e-9 < inside_m(b);
                               }),
              polygon.end());
  const auto first = static_cast<std::uint32_t>(mesh_.vertices.size());
  for (const Vector2d& p : polygon) add_vertex(p, height_m, Vector2d::Zero());
  for (std::uint32_t i = 2; i < polygon.size(); ++i) {
    mesh_.indices.insert(mesh_.indices.end(), {first, first + i - 1, first + i});
  }
}

void GroundBuilder::add_in_cells(const Polygon& polygon, double height_m) {
  constexpr double kMaxCells = 48;
  Eigen::AlignedBox2d bounds;
  for (const Vector2d& p : polygon) bounds.extend(p);
  const double cell = std::max(kMinCellM, bounds.sizes().maxCoeff() / kMaxCells);
  for (double x = bounds.min().x(); x < bounds.max().x(); x += cell) {
    const Polygon column = cut(cut(polygon, {1, 0}, x + cell), {-1, 0}, -x);
    for (double y = bounds.min().y(); y < bounds.max().y(); y += cell) {
      add(cut(cut(column, {0, 1}, y + cell), {0, -1}, -y), height_m);
    }
  }
}

void GroundBuilder::add_strip(const GroundSegment& segment, double near_m, double far_m,
                              double height_m) {
  set_axes(segment);
  const Vector2d near = near_m * segment.left();
  const Vector2d far = far_m * segment.left();
  for (const auto& [from, to] : in_pieces(segment)) {
    add({from + near, to + near, to + far, from + far}, height_m);
  }
}

void GroundBuilder::add_side(const GroundSegment& segment, double height_m) {
  set_axes(segment);
  const Vector2d facing = -segment.left();
  const std::uint32_t first = add_vertex(segment.from, 0, facing);
  add_vertex(segment.to, 0, facing);
  add_vertex(segment.to, height_m, facing);
  add_vertex(segment.from, height_m, facing);
  mesh_.indices.insert(mesh_.indices.end(),
                       {first, first + 1, first + 2, first, first + 2, first + 3});
}

double GroundBuilder::inside_m(const Vector2d& point) const {
  return outline_.empty() ? 0 : std::max(0.0, -geometry::signed_distance_to(outline_, point));
}

std::uint32_t GroundBuilder::add_vertex(const Vector2d& point, double height_m,
                                        const Vector2d& facing) {
  const auto number = static_cast<std::uint32_t>(mesh_.vertices.size());
  const Vector2d off = point - axes_.from;
  mesh_.vertices.push_back(
      {{static_cast<float>(point.x()), static_cast<float>(point.y()), static_cast<float>(height_m)},
       {static_cast<float>(facing.x()), static_cast<float>(facing.y()),
        facing.isZero() ? 1.0F : 0.0F},
       {tone_ * ground_tone_at(point),
        outline_.empty() ? 0 : static_cast<float>(1 + inside_m(point)),
        static_cast<float>(off.dot(axes_.along())), static_cast<float>(off.dot(axes_.left()))},
       kIdGround,
       0,
       {}});
  return number;
}

}  // namespace throng::render
