#include "crowd/models/orca_lines.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/geometry/polygon.h"

namespace throng::crowd {

namespace {

/// The unit vector along v; any when v is 0.
Eigen::Vector2f unit(const Eigen::Vector2f& v) {
  const float length = v.norm();
  return length > 0 ? Eigen::Vector2f(v / length) : Eigen::Vector2f::UnitX();
}

/// The directions of the two tangents from the origin to a disc at `centre`.
struct Tangents {
  Eigen::Vector2f left;
  Eigen::Vector2f right;
};

Tangents tangents(const Eigen::Vector2f& center, float radius) {
  const float distance_sq = center.squaredNorm();
  const float length = std::sqrt(std::max(0.0F, distance_sq - radius * radius));
  const Eigen::Vector2f along = length * center / distance_sq;
  const Eigen::Vector2f across = radius * turn_left(center) / distance_sq;
  return {along + across, along - across};
}

/// Velocities that take a disc to a wall within the horizon: a capsule (the wall seen at the
/// horizon) and the cone behind it between two legs.
struct VelocityObstacle {
  Eigen::Vector2f left_end;  // of the wall at the horizon, in velocities
  Eigen::Vector2f right_end;
  Eigen::Vector2f left_leg;  // unit
  Eigen::Vector2f right_leg;
  Eigen::Vector2f wall_direction;
  float radius = 0;               // of the capsule
  bool point = false;             // the wall is seen as one of its corners
  bool left_leg_is_wall = false;  // the leg runs along the neighboring wall, which bounds it
  bool right_leg_is_wall = false;
};

/// The half-plane outside a circle of the capsule's radius, in the direction of v.
HalfPlane outside_circle(const Eigen::Vector2f& center, float radius, const Eigen::Vector2f& v) {
  const Eigen::Vector2f outward = unit(v - center);
  return {center + radius * outward, -turn_left(outward)};
}

HalfPlane outside_line(const Eigen::Vector2f& through, const Eigen::Vector2f& direction,
                       float radius) {
  return {through + radius * turn_left(direction), direction};
}

/// The half-plane at the point of the obstacle's boundary that is nearest to v; nothing when that
/// is on a neighboring wall, which has its own half-plane.
std::optional<HalfPlane> nearest_boundary(const VelocityObstacle& vo, const Eigen::Vector2f& v) {
  const Eigen::Vector2f across = vo.right_end - vo.left_end;
  const Eigen::Vector2f from_left = v - vo.left_end;
  const Eigen::Vector2f from_right = v - vo.right_end;
  const float t = vo.point ? 0.5F : from_left.dot(across) / across.squaredNorm();
  const float along_left = from_left.dot(vo.left_leg);
  const float along_right = from_right.dot(vo.right_leg);
  const bool before_both = along_left < 0 && along_right < 0;
  if ((t < 0 && along_left < 0) || (vo.point && before_both)) {
    return outside_circle(vo.left_end, vo.radius, v);
  }
  if (t > 1 && along_right < 0) return outside_circle(vo.right_end, vo.radius, v);

  constexpr float kFar = std::numeric_limits<float>::infinity();
  const bool beside = t < 0 || t > 1 || vo.point;
  const float to_cutoff = beside ? kFar : (from_left - t * across).squaredNorm();
  const float to_left =
      along_left < 0 ? kFar : (from_left - along_left * vo.left_leg).squaredNorm();
  const float to_right =
      along_right < 0 ? kFar : (from_right - along_right * vo.right_leg).squaredNorm();
  if (to_cutoff <= to_left && to_cutoff <= to_right) {
    return outside_line(vo.left_end, -vo.wall_direction, vo.radius);
  }
  if (to_left <= to_right) {
    if (vo.left_leg_is_wall) return std::nullopt;
    return outside_line(vo.left_end, vo.left_leg, vo.radius);
  }
  if (vo.right_leg_is_wall) return std::nullopt;
  return outside_line(vo.right_end, -vo.right_leg, vo.radius);
}

/// Builds a wall's half-plane for one disc.
class WallAvoidance {
 public:
  WallAvoidance(const Disc& self, const std::vector<Segment>& segments, float horizon_s)
      : self_(self), segments_(segments), rate_(1 / horizon_s) {}

  /// Whether the planes so far keep the whole wall out of reach.
  bool covered(const Segment& wall, const HalfPlanes& planes) const {
    const float radius = rate_ * self_.radius;
    const Eigen::Vector2f begin = rate_ * (wall.begin - self_.position);
    const Eigen::Vector2f end = rate_ * (wall.end - self_.position);
    for (std::size_t i = 0; i < planes.size(); ++i) {
      const HalfPlane plane = planes[i];
      if (geometry::cross(begin - plane.point, plane.direction) - radius >= -kOrcaEpsilon &&
          geometry::cross(end - plane.point, plane.direction) - radius >= -kOrcaEpsilon) {
        return true;
      }
    }
    return false;
  }

  std::optional<HalfPlane> plane(const Segment& wall) const {
    const Eigen::Vector2f to_begin = wall.begin - self_.position;
    const Eigen::Vector2f to_end = wall.end - self_.position;
    const float along = -to_begin.dot(wall.direction);
    const float length = (wall.end - wall.begin).norm();
    const float radius_sq = self_.radius * self_.radius;
    const Segment& next = segments_[wall.next];
    const bool line_near = std::abs(geometry::cross(wall.direction, to_begin)) <= self_.radius;

    if (along < 0 && to_begin.squaredNorm() <= radius_sq) {
      if (!wall.convex) return std::nullopt;
      return stop_at(to_begin);
    }
    if (along > length && to_end.squaredNorm() <= radius_sq) {
      // The next wall deals with a corner that it also faces.
      if (!next.convex || geometry::cross(to_end, next.direction) < 0) return std::nullopt;
      return stop_at(to_end);
    }
    if (along >= 0 && along <= length && line_near) {
      return HalfPlane{Eigen::Vector2f::Zero(), -wall.direction};
    }
    // Seen from its end, only the nearer corner of a wall matters.
    if (along < 0 && line_near) {
      if (!wall.convex) return std::nullopt;
      return nearest_boundary(cone(wall, wall, true), self_.velocity);
    }
    if (along > length && line_near) {
      if (!next.convex) return std::nullopt;
      return nearest_boundary(cone(next, next, true), self_.velocity);
    }
    return nearest_boundary(cone(wall, next, false), self_.velocity);
  }

 private:
  /// Touching a corner: no nearer.
  static HalfPlane stop_at(const Eigen::Vector2f& corner) {
    return {Eigen::Vector2f::Zero(), unit(turn_left(corner))};
  }

  /// The velocity obstacle of the wall from the corner where `left` begins to the one where
  /// `right` begins.
  VelocityObstacle cone(const Segment& left, const Segment& right, bool point) const {
    const Eigen::Vector2f to_left = left.begin - self_.position;
    const Eigen::Vector2f to_right = right.begin - self_.position;
    VelocityObstacle vo;
    vo.point = point;
    vo.wall_direction = left.direction;
    vo.radius = rate_ * self_.radius;
    vo.left_end = rate_ * to_left;
    vo.right_end = rate_ * to_right;
    vo.left_leg = left.convex ? tangents(to_left, self_.radius).left : -left.direction;
    vo.right_leg = right.convex ? tangents(to_right, self_.radius).right : left.direction;
    // A leg that would cut into the neighboring wall runs along it instead.
    const Eigen::Vector2f before = -segments_[left.previous].direction;
    if (left.convex && geometry::cross(vo.left_leg, before) >= 0) {
      vo.left_leg = before;
      vo.left_leg_is_wall = true;
    }
    if (right.convex && geometry::cross(vo.right_leg, right.direction) <= 0) {
      vo.right_leg = right.direction;
      vo.right_leg_is_wall = true;
    }
    return vo;
  }

  const Disc& self_;
  const std::vector<Segment>& segments_;
  float rate_;  // 1/s
};

}  // namespace

void avoid_walls(const Disc& self, const std::vector<Segment>& segments,
                 std::span<const Obstacles::Near> near, float horizon_s, HalfPlanes& planes) {
  const WallAvoidance avoidance(self, segments, horizon_s);
  for (const Obstacles::Near& wall : near) {
    const Segment& segment = segments[wall.segment];
    if (avoidance.covered(segment, planes)) continue;
    if (const auto plane = avoidance.plane(segment)) planes.push_back(*plane);
  }
}

}  // namespace throng::crowd
