#include "places/imports/osm/osm_gates.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace throng::imports {

using Eigen::Vector2d;

namespace {

constexpr double kNearEdgeM = 1;
constexpr double kMinWidthM = 2;
constexpr double kMaxWidthM = 12;
constexpr double kRoadShare = 0.3;  // cars have the rest

/// A stretch of one side of the scenario, from its first corner (m).
struct Stretch {
  double from;
  double to;
  double share;
};

struct Side {
  Vector2d from;
  Vector2d along;
  double length;
  std::vector<Stretch> stretches;
};

// Position along a side of a segment that meets it or comes near enough.
std::optional<double> meets(const Side& side, const Vector2d& a, const Vector2d& b) {
  const Vector2d in(-side.along.y(), side.along.x());
  const double depth_a = (a - side.from).dot(in);
  const double depth_b = (b - side.from).dot(in);
  if (std::min(depth_a, depth_b) > kNearEdgeM || std::max(depth_a, depth_b) < kNearEdgeM) {
    return std::nullopt;
  }
  const double share = std::clamp(depth_a / (depth_a - depth_b), 0.0, 1.0);
  const double at = (a + share * (b - a) - side.from).dot(side.along);
  if (!(at >= 0 && at <= side.length)) return std::nullopt;
  return at;
}

void add_stretches(const UsedWay& way, Side& side) {
  const double width = std::clamp(way.kind.width_m, kMinWidthM, kMaxWidthM);
  const double share = (way.kind.road ? kRoadShare : 1.0) * width;
  const auto& points = way.line->points;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const auto at = meets(side, points[i], points[i + 1]);
    if (!at || side.length < width) continue;
    const double middle = std::clamp(*at, 0.5 * width, side.length - 0.5 * width);
    side.stretches.push_back({middle - 0.5 * width, middle + 0.5 * width, share});
  }
}

}  // namespace

std::optional<std::pair<Vector2d, Vector2d>> part_within(const Vector2d& from, const Vector2d& to,
                                                         const world::Rectangle& area) {
  const Vector2d way = to - from;
  double first = 0;
  double last = 1;
  for (int axis = 0; axis < 2; ++axis) {
    const std::array<double, 2> steps = {-way[axis], way[axis]};
    const std::array<double, 2> rooms = {from[axis] - area.min[axis], area.max[axis] - from[axis]};
    for (std::size_t i = 0; i < 2; ++i) {
      if (steps[i] == 0) {
        if (rooms[i] < 0) return std::nullopt;
      } else if (steps[i] < 0) {
        first = std::max(first, rooms[i] / steps[i]);
      } else {
        last = std::min(last, rooms[i] / steps[i]);
      }
    }
  }
  constexpr double kMinLengthM = 0.1;
  if ((last - first) * way.norm() < kMinLengthM) return std::nullopt;
  return std::pair<Vector2d, Vector2d>(from + first * way, from + last * way);
}

std::vector<Gate> gates_at_edge(const std::vector<UsedWay>& ways, const world::Rectangle& inside) {
  const Corners corners = rectangle_corners(inside);
  std::vector<Gate> gates;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector2d span = corners[(i + 1) % corners.size()] - corners[i];
    Side side{corners[i], span.normalized(), span.norm(), {}};
    for (const UsedWay& way : ways) add_stretches(way, side);
    std::sort(side.stretches.begin(), side.stretches.end(),
              [](const Stretch& a, const Stretch& b) { return a.from < b.from; });
    for (std::size_t k = 0; k < side.stretches.size();) {
      Stretch whole = side.stretches[k++];
      while (k < side.stretches.size() && side.stretches[k].from <= whole.to) {
        whole.to = std::max(whole.to, side.stretches[k].to);
        whole.share += side.stretches[k++].share;
      }
      gates.push_back(
          {side.from + whole.from * side.along, side.from + whole.to * side.along, whole.share});
    }
  }
  return gates;
}

}  // namespace throng::imports
