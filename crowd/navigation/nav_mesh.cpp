#include "crowd/navigation/nav_mesh.h"

#include <limits>

#include "base/geometry/polygon.h"
#include "base/geometry/rectangle.h"
#include "crowd/spatial/obstacles.h"

namespace throng::crowd {

namespace {

/// A point may be this far outside of a polygon and still be in it, in m: of two neighbors, one
/// has the points on their common edge.
constexpr float kTolerance = 1e-4F;

Eigen::Vector2f nearest_on(const NavPolygon& polygon, const Eigen::Vector2f& point) {
  Eigen::Vector2f best = point;
  float best_sq = std::numeric_limits<float>::infinity();
  const std::size_t count = polygon.corners.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector2f on_edge =
        geometry::nearest_on_segment(polygon.corners[i], polygon.corners[(i + 1) % count], point);
    const float distance_sq = (on_edge - point).squaredNorm();
    if (distance_sq >= best_sq) continue;
    best_sq = distance_sq;
    best = on_edge;
  }
  return best;
}

}  // namespace

NavMesh::NavMesh(std::vector<NavPolygon> polygons) : polygons_(std::move(polygons)) {
  std::vector<Box> boxes;
  boxes.reserve(polygons_.size());
  for (const NavPolygon& polygon : polygons_)
    boxes.push_back(geometry::bounding_box(polygon.corners));
  if (!boxes.empty()) bounds_ = boxes.front();
  for (const Box& box : boxes) bounds_.extend(box);
  tree_.build(boxes);
  find_islands();
}

void NavMesh::find_islands() {
  for (NavPolygon& polygon : polygons_) polygon.island = -1;
  std::vector<int> reached;
  int island = 0;
  for (std::size_t first = 0; first < polygons_.size(); ++first) {
    if (polygons_[first].island >= 0) continue;
    polygons_[first].island = island;
    reached.push_back(static_cast<int>(first));
    while (!reached.empty()) {
      const int polygon = reached.back();
      reached.pop_back();
      for (const Portal& portal : (*this)[polygon].portals) {
        int& behind = polygons_[static_cast<std::size_t>(portal.to)].island;
        if (behind >= 0) continue;
        behind = island;
        reached.push_back(portal.to);
      }
    }
    ++island;
  }
}

bool NavMesh::contains(int polygon, const Eigen::Vector2f& point) const {
  const std::vector<Eigen::Vector2f>& corners = (*this)[polygon].corners;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2f& a = corners[i];
    const Eigen::Vector2f edge = corners[i + 1 < corners.size() ? i + 1 : 0] - a;
    const float side = geometry::cross(edge, point - a);
    if (side < 0 && side * side > kTolerance * kTolerance * edge.squaredNorm()) return false;
  }
  return true;
}

int NavMesh::find(const Eigen::Vector2f& point, int hint) const {
  if (hint >= 0) {
    if (contains(hint, point)) return hint;
    for (const Portal& portal : (*this)[hint].portals) {
      if (contains(portal.to, point)) return portal.to;
    }
  }
  int found = -1;
  const float range_sq = kTolerance * kTolerance;
  tree_.near(point, range_sq, [&](int i) {
    const int polygon = tree_.order()[static_cast<std::size_t>(i)];
    if ((found < 0 || polygon < found) && contains(polygon, point)) found = polygon;
  });
  return found;
}

NavMesh::Location NavMesh::nearest(const Eigen::Vector2f& point, int island) const {
  Location best;
  float best_sq = std::numeric_limits<float>::infinity();
  tree_.near(point, best_sq, [&](int i) {
    const int polygon = tree_.order()[static_cast<std::size_t>(i)];
    if (island >= 0 && (*this)[polygon].island != island) return;
    const Eigen::Vector2f on =
        contains(polygon, point) ? point : nearest_on((*this)[polygon], point);
    const float distance_sq = (on - point).squaredNorm();
    if (distance_sq < best_sq || (distance_sq == best_sq && polygon < best.polygon)) {
      best = {polygon, on};
      best_sq = distance_sq;
    }
  });
  return best;
}

bool NavMesh::is_clear(const Location& from, const Eigen::Vector2f& to) const {
  const Eigen::Vector2f way = to - from.point;
  const float slack = kTolerance * way.norm();
  int polygon = from.polygon;
  int before = -1;
  for (std::size_t passed = 0; polygon >= 0 && passed <= polygons_.size(); ++passed) {
    if (contains(polygon, to)) return true;
    int next = -1;
    for (const Portal& portal : (*this)[polygon].portals) {
      if (portal.to == before) continue;
      const bool between = geometry::cross(way, portal.left - from.point) >= -slack &&
                           geometry::cross(way, portal.right - from.point) <= slack;
      const bool leaves = geometry::cross(way, portal.left - portal.right) > 0;
      if (between && leaves) next = portal.to;
    }
    before = polygon;
    polygon = next;
  }
  return false;
}

}  // namespace throng::crowd
