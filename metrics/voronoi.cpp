#include "metrics/voronoi.h"

#include <boost/geometry/algorithms/append.hpp>
#include <boost/geometry/algorithms/area.hpp>
#include <boost/geometry/algorithms/correct.hpp>
#include <boost/geometry/algorithms/difference.hpp>
#include <boost/geometry/algorithms/within.hpp>
#include <boost/geometry/geometries/multi_polygon.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>
#include <boost/geometry/strategies/strategies.hpp>
#include <cmath>
#include <numbers>

#include "world/polygon.h"

namespace throng::metrics {

using Eigen::Vector2d;

namespace {

namespace bg = boost::geometry;

using CellPoint = bg::model::d2::point_xy<double>;
using CellPolygon = bg::model::polygon<CellPoint, false>;
using CellPolygons = bg::model::multi_polygon<CellPolygon>;

constexpr int kDiscCorners = 32;
// Overlaps below this are rounding.
constexpr double kNoAreaM2 = 1e-9;

// Cuts a ring to a convex region (Sutherland and Hodgman 1974). A ring that is not convex may get
// edges that lie on each other, which its signed area does not notice.
void clip_to(Ring& ring, std::span<const Vector2d> region) {
  for (std::size_t i = 0; i < region.size() && !ring.empty(); ++i) {
    const Vector2d edge = region[(i + 1) % region.size()] - region[i];
    clip(ring, region[i], Vector2d(edge.y(), -edge.x()));
  }
}

CellPolygon polygon_from(const Ring& ring) {
  CellPolygon polygon;
  for (const Vector2d& corner : ring) {
    bg::append(polygon.outer(), CellPoint(corner.x(), corner.y()));
  }
  bg::correct(polygon);
  return polygon;
}

template <typename BoostRing>
Ring ring_from(const BoostRing& boost_ring) {
  Ring ring;
  // The first corner is repeated at the end.
  for (std::size_t i = 0; i + 1 < boost_ring.size(); ++i) {
    ring.emplace_back(boost_ring[i].x(), boost_ring[i].y());
  }
  return ring;
}

}  // namespace

void clip(Ring& ring, const Vector2d& point, const Vector2d& normal) {
  thread_local std::vector<double> beyond;
  beyond.clear();
  bool all_inside = true;
  for (const Vector2d& corner : ring) {
    beyond.push_back((corner - point).dot(normal));
    all_inside = all_inside && beyond.back() <= 0;
  }
  if (all_inside) return;
  thread_local Ring kept;
  kept.clear();
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const std::size_t j = i + 1 < ring.size() ? i + 1 : 0;
    if (beyond[i] <= 0) kept.push_back(ring[i]);
    if ((beyond[i] <= 0) != (beyond[j] <= 0)) {
      kept.push_back(ring[i] + beyond[i] / (beyond[i] - beyond[j]) * (ring[j] - ring[i]));
    }
  }
  ring = kept;
}

double area_in(const VoronoiCell& cell, std::span<const Vector2d> convex_region) {
  double area = 0;
  for (Ring ring : cell.rings) {
    clip_to(ring, convex_region);
    area += world::signed_area(ring);
  }
  return area;
}

VoronoiCutter::VoronoiCutter(std::span<const world::Building> buildings) {
  for (const world::Building& building : buildings) {
    Footprint& footprint = footprints_.emplace_back(
        Footprint{building.footprint, building.footprint.front(), building.footprint.front()});
    for (const Vector2d& corner : footprint.ring) {
      footprint.min = footprint.min.cwiseMin(corner);
      footprint.max = footprint.max.cwiseMax(corner);
    }
  }
  const double step = 2 * std::numbers::pi / kDiscCorners;
  const double radius = kCellRadiusM * std::sqrt(step / std::sin(step));
  for (int i = 0; i < kDiscCorners; ++i) {
    disc_.emplace_back(radius * std::cos(i * step), radius * std::sin(i * step));
  }
}

VoronoiCell VoronoiCutter::cell(const PointGrid& people, std::size_t index) const {
  const Vector2d& person = people[index];
  VoronoiCell cell;
  Ring& ring = cell.rings.emplace_back(disc_);
  for (Vector2d& corner : ring) corner += person;
  double reach = 1.01 * kCellRadiusM;
  bool more = true;
  for (int number = 0; more; ++number) {
    more = people.for_ring(person, number, [&](std::size_t other) {
      const Vector2d offset = people[other] - person;
      const double squared = offset.squaredNorm();
      if (other == index || squared > 4 * reach * reach) return;
      if (squared == 0) {
        ++cell.sharers;
      } else {
        clip(ring, person + 0.5 * offset, offset);
      }
    });
    reach = 0;
    for (const Vector2d& corner : ring) reach = std::max(reach, (corner - person).norm());
    if (number * people.cell_m() >= 2 * reach) break;
  }
  cell.area_m2 = world::signed_area(ring);
  take_away_buildings(person, cell);
  return cell;
}

void VoronoiCutter::take_away_buildings(const Vector2d& person, VoronoiCell& cell) const {
  CellPolygons ground;
  for (const Footprint& footprint : footprints_) {
    const Eigen::Array2d gap = (footprint.min - person).cwiseMax(person - footprint.max).array();
    if ((gap > 1.01 * kCellRadiusM).any()) continue;
    Ring common = footprint.ring;
    clip_to(common, cell.rings.front());
    if (world::signed_area(common) < kNoAreaM2) continue;
    if (ground.empty()) ground.push_back(polygon_from(cell.rings.front()));
    CellPolygons rest;
    bg::difference(ground, polygon_from(footprint.ring), rest);
    // Somebody pressed into a wall by rounding still stands somewhere.
    if (bg::area(rest) < kNoAreaM2) continue;
    ground = std::move(rest);
  }
  if (ground.empty()) return;
  const CellPolygon* own = &ground.front();
  for (const CellPolygon& part : ground) {
    if (bg::within(CellPoint(person.x(), person.y()), part)) own = &part;
  }
  cell.rings = {ring_from(own->outer())};
  for (const auto& hole : own->inners()) cell.rings.push_back(ring_from(hole));
  cell.area_m2 = bg::area(*own);
}

}  // namespace throng::metrics
