#include "metrics/density/voronoi.h"

#include <algorithm>
#include <bit>
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
#include <cstdint>
#include <numbers>
#include <utility>

#include "base/geometry/point_grid.h"
#include "base/geometry/polygon.h"
#include "base/geometry/rectangle.h"

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

// Somebody whose half of the ground is to be cut away.
struct Neighbor {
  double squared_m2 = 0;
  Vector2d offset;
};

// Neighbors by distance. Numbers are sorted, which is quick: each is a distance to 32 binary
// digits (the bits of doubles that are not negative are in their order) and the neighbor's place
// in the list.
class Neighbors {
 public:
  void clear() {
    list_.clear();
    order_.clear();
  }
  void add(const Vector2d& offset, double squared_m2) {
    order_.push_back((std::bit_cast<std::uint64_t>(squared_m2) & ~kIndexMask) |
                     (list_.size() & kIndexMask));
    list_.push_back({squared_m2, offset});
  }
  void sort() { std::sort(order_.begin(), order_.end()); }
  std::size_t size() const { return list_.size(); }
  const Neighbor& operator[](std::size_t i) const { return list_[order_[i] & kIndexMask]; }

 private:
  static constexpr std::uint64_t kIndexMask = (1U << 20U) - 1;  // a million neighbors
  std::vector<Neighbor> list_;
  std::vector<std::uint64_t> order_;
};

// Memory that is used again and again.
struct Scratch {
  std::vector<double> beyond;
  Ring kept;
  Neighbors near;
};

// Cuts away what lies beyond the line through `point`, on the side to which `normal` points. False
// where that is nothing.
bool clip(Ring& ring, const Vector2d& point, const Vector2d& normal, Scratch& scratch) {
  const std::size_t corners = ring.size();
  std::vector<double>& beyond = scratch.beyond;
  beyond.resize(corners);
  bool all_inside = true;
  for (std::size_t i = 0; i < corners; ++i) {
    beyond[i] = (ring[i] - point).dot(normal);
    all_inside &= beyond[i] <= 0;
  }
  if (all_inside) return false;
  geometry::clip<Vector2d>(ring, beyond, scratch.kept);
  std::swap(ring, scratch.kept);
  return true;
}

// Cuts a ring to a convex region.
void clip_to(Ring& ring, std::span<const Vector2d> region) {
  thread_local Scratch scratch;
  for (std::size_t i = 0; i < region.size() && !ring.empty(); ++i) {
    const Vector2d edge = region[(i + 1) % region.size()] - region[i];
    clip(ring, region[i], Vector2d(edge.y(), -edge.x()), scratch);
  }
}

// Whether the ring lies on one side of a box.
bool beside(const Ring& ring, const geometry::Rectangle& box) {
  const auto [low, high] = geometry::bounding_box(ring);
  return (low.array() >= box.max.array()).any() || (high.array() <= box.min.array()).any();
}

double max_distance_sq(const Ring& ring, const Vector2d& from) {
  double farthest = 0;
  for (const Vector2d& corner : ring) {
    farthest = std::max(farthest, (corner - from).squaredNorm());
  }
  return farthest;
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

double area_in(const VoronoiCell& cell, std::span<const Vector2d> convex_region) {
  thread_local Ring ring;
  double area = 0;
  for (const Ring& whole : cell.rings) {
    ring = whole;
    clip_to(ring, convex_region);
    area += geometry::signed_area(ring);
  }
  return area;
}

VoronoiCutter::VoronoiCutter(std::span<const world::Building> buildings) {
  for (const world::Building& building : buildings) {
    footprints_.push_back({building.footprint, geometry::bounding_box(building.footprint)});
  }
  const double step = 2 * std::numbers::pi / kDiscCorners;
  const double radius = kCellRadiusM * std::sqrt(step / std::sin(step));
  for (int i = 0; i < kDiscCorners; ++i) {
    disc_.emplace_back(radius * std::cos(i * step), radius * std::sin(i * step));
  }
}

VoronoiCell VoronoiCutter::cell(const geometry::PointGrid& people, std::size_t index) const {
  VoronoiCell cell;
  cut(people, index, cell);
  return cell;
}

void VoronoiCutter::cut(const geometry::PointGrid& people, std::size_t index,
                        VoronoiCell& cell) const {
  thread_local Scratch scratch;
  Scratch& memory = scratch;
  const Vector2d& person = people[index];
  // A square at first, cut to the disc at the end where that is needed: few corners are quick.
  const double radius = disc_.front().x();
  cell.rings.resize(1);
  cell.sharers = 1;
  Ring& ring = cell.rings.front();
  ring.clear();
  for (const Vector2d& sign :
       {Vector2d(1, 1), Vector2d(-1, 1), Vector2d(-1, -1), Vector2d(1, -1)}) {
    ring.emplace_back(person + radius * sign);
  }
  double reach_sq = radius * radius;
  auto& near = memory.near;
  near.clear();
  bool more = people.for_ring(person, 0, [&](std::size_t other, const Vector2d& place) {
    const Vector2d offset = place - person;
    if (other != index) near.add(offset, offset.squaredNorm());
  });
  for (int number = 1; more; ++number) {
    more = people.for_ring(person, number, [&](std::size_t, const Vector2d& place) {
      const Vector2d offset = place - person;
      const double squared = offset.squaredNorm();
      if (squared <= 4 * reach_sq) near.add(offset, squared);
    });
    // The nearest cut most: who is beyond what they leave cuts nothing.
    near.sort();
    for (std::size_t i = 0; i < near.size(); ++i) {
      const auto& [squared, offset] = near[i];
      if (squared > 4 * reach_sq) break;
      if (squared == 0) {
        ++cell.sharers;
        continue;
      }
      if (!clip(ring, person + 0.5 * offset, offset, memory)) continue;
      reach_sq = std::min(reach_sq, max_distance_sq(ring, person));
    }
    near.clear();
    const double seen_m = number * people.cell_m();
    if (seen_m * seen_m >= 4 * reach_sq) break;
  }
  const double inner = radius * std::cos(std::numbers::pi / kDiscCorners);
  if (max_distance_sq(ring, person) > inner * inner) {
    Ring disc = disc_;
    for (Vector2d& corner : disc) corner += person;
    clip_to(ring, disc);
  }
  cell.area_m2 = geometry::signed_area(ring);
  take_away_buildings(person, cell);
}

void VoronoiCutter::take_away_buildings(const Vector2d& person, VoronoiCell& cell) const {
  CellPolygons ground;
  for (const Footprint& footprint : footprints_) {
    const Eigen::Array2d gap =
        (footprint.bounds.min - person).cwiseMax(person - footprint.bounds.max).array();
    if ((gap > 1.01 * kCellRadiusM).any()) continue;
    // Most footprints near are not reached by the cell.
    if (beside(cell.rings.front(), footprint.bounds)) continue;
    Ring common = footprint.ring;
    clip_to(common, cell.rings.front());
    if (geometry::signed_area(common) < kNoAreaM2) continue;
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
