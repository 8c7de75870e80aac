#include "metrics/bounds/path_bound.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

#include "base/geometry/polygon.h"
#include "base/geometry/rectangle.h"

namespace throng::metrics {

using Eigen::Vector2d;

namespace {

constexpr double kNoPath = std::numeric_limits<double>::infinity();
constexpr double kTouchingM = 1e-6;

// Whether two points lie on different sides of a line, each farther from it than touching.
bool on_both_sides(const Vector2d& line_from, const Vector2d& line_to, const Vector2d& one,
                   const Vector2d& other) {
  const Vector2d along = line_to - line_from;
  const double touching = kTouchingM * along.norm();
  const double a = geometry::cross(along, one - line_from);
  const double b = geometry::cross(along, other - line_from);
  return (a > touching && b < -touching) || (a < -touching && b > touching);
}

// Inside a polygon and not on its outline.
bool is_deep_inside(const std::vector<Vector2d>& corners, const Vector2d& place) {
  if (geometry::distance_to(corners, place) > 0) return false;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector2d& next = corners[(i + 1) % corners.size()];
    if (geometry::distance_to_segment(corners[i], next, place) < kTouchingM) return false;
  }
  return true;
}

}  // namespace

PathBound::PathBound(const world::Scenario& scenario, double margin_m) {
  for (const world::Building& building : scenario.buildings) {
    Outline outline{building.footprint, geometry::bounding_box(building.footprint)};
    for (std::size_t i = 0; i < outline.corners.size(); ++i) {
      const std::size_t count = outline.corners.size();
      const Vector2d& corner = outline.corners[i];
      const Vector2d before = corner - outline.corners[(i + count - 1) % count];
      const Vector2d after = outline.corners[(i + 1) % count] - corner;
      if (geometry::cross(before, after) > 0) corners_.push_back(corner);
    }
    outlines_.push_back(std::move(outline));
  }
  if (corners_.size() > kMaxCorners) {
    outlines_.clear();
    corners_.clear();
  }
  std::vector<std::vector<double>> between(corners_.size(),
                                           std::vector<double>(corners_.size(), kNoPath));
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (!is_free(corners_[i], corners_[j])) continue;
      between[i][j] = between[j][i] = (corners_[i] - corners_[j]).norm();
    }
  }
  for (const world::Exit& exit : scenario.exits) {
    const Vector2d wider = margin_m * (exit.to - exit.from).normalized();
    doors_.push_back({exit.from, exit.to, exit.from - wider, exit.to + wider, {}});
    find_corner_paths(between, doors_.back());
  }
}

// Dijkstra's algorithm from the door.
void PathBound::find_corner_paths(const std::vector<std::vector<double>>& between,
                                  Door& door) const {
  using Entry = std::pair<double, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    door.from_corner_m.push_back(seen_m(door, corners_[i]));
    if (std::isfinite(door.from_corner_m[i])) open.emplace(door.from_corner_m[i], i);
  }
  while (!open.empty()) {
    const auto [length_m, corner] = open.top();
    open.pop();
    if (length_m > door.from_corner_m[corner]) continue;
    for (std::size_t next = 0; next < corners_.size(); ++next) {
      const double by_here_m = length_m + between[corner][next];
      if (by_here_m >= door.from_corner_m[next]) continue;
      door.from_corner_m[next] = by_here_m;
      open.emplace(by_here_m, next);
    }
  }
}

double PathBound::straight_m(const Door& door, const Vector2d& place) const {
  return (place - geometry::nearest_on_segment(door.wide_from, door.wide_to, place)).norm();
}

double PathBound::seen_m(const Door& door, const Vector2d& place) const {
  const bool seen =
      is_free(place, geometry::nearest_on_segment(door.wide_from, door.wide_to, place)) ||
      is_free(place, geometry::nearest_on_segment(door.from, door.to, place));
  return seen ? straight_m(door, place) : kNoPath;
}

double PathBound::to_door_m(std::size_t exit, const Vector2d& place) const {
  const Door& door = doors_[exit];
  const double straight = straight_m(door, place);
  if (is_inside_building(place) || std::isfinite(seen_m(door, place))) return straight;
  std::vector<std::pair<double, std::size_t>> by_corner;
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const double length_m = (corners_[i] - place).norm() + door.from_corner_m[i];
    if (std::isfinite(length_m)) by_corner.emplace_back(length_m, i);
  }
  std::sort(by_corner.begin(), by_corner.end());
  for (const auto& [length_m, corner] : by_corner) {
    if (is_free(place, corners_[corner])) return length_m;
  }
  return straight;
}

bool PathBound::is_inside_building(const Vector2d& place) const {
  return std::any_of(outlines_.begin(), outlines_.end(), [&](const Outline& outline) {
    return outline.bounds.contains(place) && is_deep_inside(outline.corners, place);
  });
}

bool PathBound::is_free(const Vector2d& from, const Vector2d& to) const {
  const geometry::Rectangle reach{from.cwiseMin(to), from.cwiseMax(to)};
  const Vector2d middle = 0.5 * (from + to);
  return std::none_of(outlines_.begin(), outlines_.end(), [&](const Outline& outline) {
    if (!reach.meets(outline.bounds)) return false;
    const std::size_t count = outline.corners.size();
    for (std::size_t i = 0; i < count; ++i) {
      const Vector2d& corner = outline.corners[i];
      const Vector2d& next = outline.corners[(i + 1) % count];
      if (on_both_sides(from, to, corner, next) && on_both_sides(corner, next, from, to)) {
        return true;
      }
    }
    // From corner to corner through a building no edge is crossed.
    return outline.bounds.contains(middle) && is_deep_inside(outline.corners, middle);
  });
}

}  // namespace throng::metrics
