#include "places/imports/parts/areas.h"

#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/linestring.hpp>
#include <boost/geometry/geometries/multi_linestring.hpp>
#include <boost/geometry/geometries/multi_polygon.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>
#include <cmath>
#include <numbers>

#include "base/geometry/polygon.h"
#include "base/geometry/rectangle.h"
#include "places/imports/parts/loops.h"

namespace throng::imports {

namespace bg = boost::geometry;
using Eigen::Vector2d;

namespace {

using Point = bg::model::d2::point_xy<double>;
using Polygon = bg::model::polygon<Point, false, true>;  // counter-clockwise, closed
using MultiPolygon = bg::model::multi_polygon<Polygon>;
using Line = bg::model::linestring<Point>;

constexpr double kSamePositionM = 1e-3;
constexpr double kStraightM = 1e-3;

void add_ring(const Corners& corners, Polygon::ring_type& ring) {
  for (const Vector2d& corner : corners) ring.emplace_back(corner.x(), corner.y());
  if (!corners.empty()) ring.emplace_back(corners.front().x(), corners.front().y());
}

Polygon to_polygon(const Area& area) {
  Polygon polygon;
  add_ring(area.outline, polygon.outer());
  for (const Corners& hole : area.holes) {
    polygon.inners().emplace_back();
    add_ring(hole, polygon.inners().back());
  }
  bg::correct(polygon);
  return polygon;
}

template <typename Ring>
Corners corners_in(const Ring& ring) {
  Corners corners;
  for (std::size_t i = 0; i + 1 < ring.size(); ++i) corners.emplace_back(ring[i].x(), ring[i].y());
  return corners;
}

// A corner that is where the next one is, or whose edges go on straight or straight back.
bool is_needless(const Vector2d& before, const Vector2d& corner, const Vector2d& after) {
  const Vector2d in = corner - before;
  const Vector2d out = after - corner;
  if (out.norm() < kSamePositionM || in.norm() < kSamePositionM) return true;
  const Vector2d span = after - before;
  if (span.norm() < kSamePositionM) return true;
  return std::abs(geometry::cross(in, span)) / span.norm() < kStraightM;
}

Corners thinned(Corners corners) {
  for (bool changed = true; changed && corners.size() >= 3;) {
    changed = false;
    for (std::size_t i = 0; i < corners.size() && corners.size() >= 3;) {
      const std::size_t count = corners.size();
      if (is_needless(corners[(i + count - 1) % count], corners[i], corners[(i + 1) % count])) {
        corners.erase(corners.begin() + static_cast<std::ptrdiff_t>(i));
        changed = true;
      } else {
        ++i;
      }
    }
  }
  if (corners.size() < 3) corners.clear();
  return corners;
}

std::vector<Area> split_areas(const MultiPolygon& polygons) {
  std::vector<Area> areas;
  for (const Polygon& polygon : polygons) {
    Area area{corners_in(polygon.outer()), {}};
    for (const auto& inner : polygon.inners()) area.holes.push_back(corners_in(inner));
    if (auto tidy = tidied(area)) areas.push_back(std::move(*tidy));
  }
  return areas;
}

Polygon box(double min_x, double min_y, double max_x, double max_y) {
  return to_polygon({rectangle_corners({{min_x, min_y}, {max_x, max_y}}), {}});
}

}  // namespace

std::optional<Area> tidied(const Area& area) {
  Area tidy{thinned(area.outline), {}};
  if (tidy.outline.empty()) return std::nullopt;
  for (const Corners& hole : area.holes) {
    Corners corners = thinned(hole);
    if (!corners.empty()) tidy.holes.push_back(std::move(corners));
  }
  const Polygon polygon = to_polygon(tidy);
  if (!bg::is_valid(polygon)) return std::nullopt;
  tidy.outline = corners_in(polygon.outer());
  for (std::size_t i = 0; i < tidy.holes.size(); ++i) {
    tidy.holes[i] = corners_in(polygon.inners()[i]);
  }
  return tidy;
}

std::vector<Area> repaired(const Area& area) {
  if (auto tidy = tidied(area)) return {std::move(*tidy)};
  MultiPolygon whole;
  for (const Corners& loop : simple_loops(area.outline)) {
    const auto tidy = tidied({loop, {}});
    if (!tidy) continue;
    MultiPolygon more;
    bg::union_(whole, to_polygon(*tidy), more);
    whole = std::move(more);
  }
  std::vector<Area> holes;
  for (const Corners& hole : area.holes) {
    for (const Corners& loop : simple_loops(hole)) {
      if (auto tidy = tidied({loop, {}})) holes.push_back(std::move(*tidy));
    }
  }
  std::vector<Area> parts;
  for (const Area& piece : split_areas(whole)) {
    for (Area& rest : without(piece, holes)) parts.push_back(std::move(rest));
  }
  constexpr double kMinAreaM2 = 0.01;
  std::erase_if(parts, [](const Area& part) { return size_m2(part) < kMinAreaM2; });
  std::stable_sort(parts.begin(), parts.end(),
                   [](const Area& a, const Area& b) { return size_m2(a) > size_m2(b); });
  return parts;
}

std::vector<Area> clipped(const Area& area, const world::Rectangle& to) {
  MultiPolygon inside;
  bg::intersection(to_polygon(area), box(to.min.x(), to.min.y(), to.max.x(), to.max.y()), inside);
  return split_areas(inside);
}

std::vector<Area> without(const Area& area, const std::vector<Area>& others) {
  MultiPolygon rest;
  rest.push_back(to_polygon(area));
  for (const Area& other : others) {
    MultiPolygon less;
    bg::difference(rest, to_polygon(other), less);
    rest = std::move(less);
  }
  return split_areas(rest);
}

std::vector<Area> along(const std::vector<Vector2d>& line, double width_m) {
  Line path;
  for (const Vector2d& point : line) {
    const Point next(point.x(), point.y());
    if (path.empty() || bg::distance(path.back(), next) > kSamePositionM) path.push_back(next);
  }
  if (path.size() < 2) return {};
  MultiPolygon band;
  bg::buffer(path, band, bg::strategy::buffer::distance_symmetric<double>(0.5 * width_m),
             bg::strategy::buffer::side_straight(), bg::strategy::buffer::join_miter(2),
             bg::strategy::buffer::end_flat(), bg::strategy::buffer::point_square());
  return split_areas(band);
}

double shared_m2(const Area& a, const Area& b) {
  MultiPolygon both;
  bg::intersection(to_polygon(a), to_polygon(b), both);
  return bg::area(both);
}

double size_m2(const Area& area) {
  double size = std::abs(geometry::signed_area(area.outline));
  for (const Corners& hole : area.holes) size -= std::abs(geometry::signed_area(hole));
  return size;
}

std::vector<Corners> simple_parts(const Area& area, double min_area_m2) {
  std::vector<Corners> parts;
  std::vector<Area> left = {area};
  while (!left.empty()) {
    const Area next = std::move(left.back());
    left.pop_back();
    if (size_m2(next) < min_area_m2) continue;
    if (next.holes.empty()) {
      if (geometry::is_simple(next.outline) && geometry::signed_area(next.outline) > 0) {
        parts.push_back(next.outline);
      } else {  // touches itself
        for (Corners& loop : simple_loops(next.outline)) {
          if (geometry::is_simple(loop)) parts.push_back(std::move(loop));
        }
      }
      continue;
    }
    const auto [low, high] = geometry::bounding_box(next.outline);
    Vector2d middle = Vector2d::Zero();
    for (const Vector2d& corner : next.holes.front()) middle += corner;
    middle /= static_cast<double>(next.holes.front().size());
    for (const auto& [from, to] :
         {std::pair(low.x() - 1, middle.x()), std::pair(middle.x(), high.x() + 1)}) {
      MultiPolygon half;
      bg::intersection(to_polygon(next), box(from, low.y() - 1, to, high.y() + 1), half);
      for (Area& piece : split_areas(half)) {
        // A hole that the cut misses by rounding would be cut for ever.
        if (piece.holes.size() < next.holes.size()) left.push_back(std::move(piece));
      }
    }
  }
  return parts;
}

Corners rectangle_corners(const world::Rectangle& rectangle) {
  const auto& [low, high] = rectangle;
  return {low, {high.x(), low.y()}, high, {low.x(), high.y()}};
}

Corners circle(const Vector2d& center, double radius_m) {
  constexpr int kCorners = 24;
  Corners corners;
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2 * std::numbers::pi * i / kCorners;
    corners.push_back(center + radius_m * Vector2d(std::cos(angle), std::sin(angle)));
  }
  return corners;
}

}  // namespace throng::imports
