#include "crowd/spatial/obstacles.h"

#include <algorithm>

#include "base/error.h"
#include "base/geometry/polygon.h"

namespace throng::crowd {

float segment_distance_sq(const Eigen::Vector2f& a, const Eigen::Vector2f& b,
                          const Eigen::Vector2f& c, const Eigen::Vector2f& d) {
  if (geometry::segments_cross(a, b, c, d)) return 0;
  return std::min({(geometry::nearest_on_segment(a, b, c) - c).squaredNorm(),
                   (geometry::nearest_on_segment(a, b, d) - d).squaredNorm(),
                   (geometry::nearest_on_segment(c, d, a) - a).squaredNorm(),
                   (geometry::nearest_on_segment(c, d, b) - b).squaredNorm()});
}

void Obstacles::add_polygon(std::span<const Eigen::Vector2f> corners,
                            std::uint32_t obstacle_class) {
  const int first = static_cast<int>(segments_.size());
  const int count = static_cast<int>(corners.size());
  check(count >= 3, "an obstacle has three corners or more");
  double area = 0;
  Box bounds{corners.front(), corners.front()};
  for (int i = 0; i < count; ++i) {
    const int next = (i + 1) % count;
    const int previous = (i + count - 1) % count;
    Segment segment;
    segment.begin = corners[i];
    segment.end = corners[next];
    segment.direction = (segment.end - segment.begin).normalized();
    segment.previous = first + previous;
    segment.next = first + next;
    segment.convex =
        geometry::cross(corners[i] - corners[previous], corners[next] - corners[i]) >= 0;
    segment.obstacle_class = obstacle_class;
    segments_.push_back(segment);
    bounds.extend(corners[i]);
    area += geometry::cross(corners[i] - corners[0], corners[next] - corners[0]);
  }
  polygons_.push_back({first, count, area >= 0, obstacle_class, bounds});
}

void Obstacles::build() {
  std::vector<Box> boxes;
  boxes.reserve(segments_.size());
  for (const Segment& segment : segments_) {
    boxes.push_back({segment.begin.cwiseMin(segment.end), segment.begin.cwiseMax(segment.end)});
  }
  tree_.build(boxes);
  walls_.clear();
  for (const int index : tree_.order()) {
    const Segment& segment = segments_[index];
    const Eigen::Vector2f edge = segment.end - segment.begin;
    const float length_sq = edge.squaredNorm();
    walls_.push_back(
        {segment.begin, edge, length_sq > 0 ? 1 / length_sq : 0, segment.obstacle_class});
  }
}

void Obstacles::near(const Eigen::Vector2f& point, float range, std::uint32_t class_mask,
                     std::vector<Near>& found) const {
  found.clear();
  const float range_sq = range * range;
  tree_.near(point, range_sq, [&](int i) {
    const Wall& wall = walls_[i];
    if ((wall.obstacle_class & class_mask) == 0) return;
    const Eigen::Vector2f from_begin = point - wall.begin;
    if (geometry::cross(wall.edge, from_begin) >= 0) return;
    const float t = std::clamp(from_begin.dot(wall.edge) * wall.inverse_length_sq, 0.0F, 1.0F);
    const float distance_sq = (from_begin - t * wall.edge).squaredNorm();
    if (distance_sq < range_sq) found.push_back({distance_sq, tree_.order()[i]});
  });
  std::sort(found.begin(), found.end(), [](const Near& a, const Near& b) {
    return a.distance_sq != b.distance_sq ? a.distance_sq < b.distance_sq : a.segment < b.segment;
  });
}

bool Obstacles::visible(const Eigen::Vector2f& from, const Eigen::Vector2f& to, float radius,
                        std::uint32_t class_mask) const {
  return !tree_.any_along(from, to, radius, [&](int i) {
    const Wall& wall = walls_[i];
    if ((wall.obstacle_class & class_mask) == 0) return false;
    const float from_side = geometry::cross(wall.edge, from - wall.begin);
    const float to_side = geometry::cross(wall.edge, to - wall.begin);
    if (from_side >= 0 || to_side <= 0) return false;
    const Eigen::Vector2f end = wall.begin + wall.edge;
    const float distance_sq = segment_distance_sq(from, to, wall.begin, end);
    return distance_sq < radius * radius || distance_sq == 0;
  });
}

bool Obstacles::encloses(const Polygon& polygon, const Eigen::Vector2f& point) const {
  if (!polygon.bounds.contains(point)) return false;
  bool inside = false;
  for (int i = polygon.first; i < polygon.first + polygon.count; ++i) {
    const Eigen::Vector2f& a = segments_[i].begin;
    const Eigen::Vector2f& b = segments_[i].end;
    if ((a.y() > point.y()) == (b.y() > point.y())) continue;
    if (point.x() < a.x() + (b.x() - a.x()) * (point.y() - a.y()) / (b.y() - a.y())) {
      inside = !inside;
    }
  }
  return inside;
}

bool Obstacles::is_solid(const Eigen::Vector2f& point, std::uint32_t class_mask) const {
  bool any_outer_wall = false;
  bool inside_outer_wall = false;
  for (const Polygon& polygon : polygons_) {
    if ((polygon.obstacle_class & class_mask) == 0) continue;
    const bool enclosed = encloses(polygon, point);
    if (polygon.solid && enclosed) return true;
    if (polygon.solid) continue;
    any_outer_wall = true;
    inside_outer_wall = inside_outer_wall || enclosed;
  }
  return any_outer_wall && !inside_outer_wall;
}

bool Obstacles::is_clear(const Eigen::Vector2f& point, float clearance_m,
                         std::uint32_t class_mask) const {
  std::vector<Near> walls;
  near(point, clearance_m, class_mask, walls);
  return walls.empty() && !is_solid(point, class_mask);
}

}  // namespace throng::crowd
