#include "metrics/basis/control_zone.h"

#include <algorithm>
#include <boost/geometry/algorithms/append.hpp>
#include <boost/geometry/algorithms/area.hpp>
#include <boost/geometry/algorithms/correct.hpp>
#include <boost/geometry/algorithms/difference.hpp>
#include <boost/geometry/algorithms/intersects.hpp>
#include <boost/geometry/geometries/multi_polygon.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>
#include <boost/geometry/strategies/strategies.hpp>
#include <cmath>
#include <numbers>

namespace throng::metrics {

namespace {

namespace bg = boost::geometry;

using Point = bg::model::d2::point_xy<double>;
using Polygon = bg::model::polygon<Point, false>;  // counter-clockwise, first corner repeated
using MultiPolygon = bg::model::multi_polygon<Polygon>;

// Corners of the arc that stands for the half circle. The polygon's area is the half disc's; what a
// building cuts off is exact to about 1e-5 of the area.
constexpr int kArcEdges = 256;

Polygon half_disc(const Eigen::Vector2d& middle, const Eigen::Vector2d& outward, double radius) {
  const double step = std::numbers::pi / kArcEdges;
  const double equal_area_radius = radius * std::sqrt(step / std::sin(step));
  const Eigen::Vector2d along(outward.y(), -outward.x());
  Polygon polygon;
  for (int i = 0; i <= kArcEdges; ++i) {
    const Eigen::Vector2d corner =
        middle + equal_area_radius * (std::cos(i * step) * along - std::sin(i * step) * outward);
    bg::append(polygon.outer(), Point(corner.x(), corner.y()));
  }
  bg::correct(polygon);
  return polygon;
}

Polygon make_polygon(const std::vector<Eigen::Vector2d>& corners) {
  Polygon polygon;
  for (const Eigen::Vector2d& corner : corners) {
    bg::append(polygon.outer(), Point(corner.x(), corner.y()));
  }
  bg::correct(polygon);
  return polygon;
}

// Even-odd rule; which side a point exactly on an edge falls to does not matter here.
bool covers(const std::vector<Eigen::Vector2d>& footprint, const Eigen::Vector2d& point) {
  bool inside = false;
  for (std::size_t i = 0, j = footprint.size() - 1; i < footprint.size(); j = i++) {
    const Eigen::Vector2d& a = footprint[i];
    const Eigen::Vector2d& b = footprint[j];
    if ((a.y() > point.y()) == (b.y() > point.y())) continue;
    const double x = a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
    if (point.x() < x) inside = !inside;
  }
  return inside;
}

}  // namespace

ControlZone::ControlZone(const world::Exit& exit, std::span<const world::Building> buildings)
    : middle_(exit.middle()),
      outward_(exit.outward),
      radius_m_(std::max(exit.length_m(), 2.0) + 1.0) {
  // Faces of walls lie on the line of a door, where differences of polygons fail: a little
  // inward nothing does.
  constexpr double kOffLineM = 1e-7;
  const Polygon whole = half_disc(middle_ - kOffLineM * outward_, outward_, radius_m_);
  for (const Point& corner : whole.outer()) outline_.emplace_back(corner.x(), corner.y());
  outline_.pop_back();  // the first corner again
  MultiPolygon walkable{whole};
  for (const world::Building& building : buildings) {
    const Polygon footprint = make_polygon(building.footprint);
    if (!bg::intersects(whole, footprint)) continue;
    MultiPolygon rest;
    bg::difference(walkable, footprint, rest);
    walkable = std::move(rest);
    footprints_.push_back(building.footprint);
  }
  area_m2_ = bg::area(walkable);
}

bool ControlZone::contains(const Eigen::Vector2d& point) const {
  const Eigen::Vector2d offset = point - middle_;
  if (offset.squaredNorm() >= radius_m_ * radius_m_ || offset.dot(outward_) >= 0) return false;
  return std::none_of(footprints_.begin(), footprints_.end(),
                      [&](const auto& footprint) { return covers(footprint, point); });
}

double ControlZone::share_of_path(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const {
  const Eigen::Vector2d start = from - middle_;
  const Eigen::Vector2d way = to - from;
  double begin = 0;
  double end = 1;
  // Inside of the line: start + s offset has to lie before it.
  const double before = start.dot(outward_);
  const double outward = way.dot(outward_);
  if (outward > 0) end = std::min(end, -before / outward);
  if (outward < 0) begin = std::max(begin, -before / outward);
  if (outward == 0 && before >= 0) return 0;
  // In the disc: between the roots of |start + s offset|² = radius².
  const double a = way.squaredNorm();
  const double b = start.dot(way);
  const double c = start.squaredNorm() - radius_m_ * radius_m_;
  if (a == 0) return c < 0 && before < 0 ? 1 : 0;
  const double root = b * b - a * c;
  if (root <= 0) return 0;
  begin = std::max(begin, (-b - std::sqrt(root)) / a);
  end = std::min(end, (-b + std::sqrt(root)) / a);
  return std::max(0.0, end - begin);
}

}  // namespace throng::metrics
