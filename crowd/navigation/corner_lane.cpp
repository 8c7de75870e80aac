#include "crowd/navigation/corner_lane.h"

#include <algorithm>
#include <cmath>

#include "base/geometry/polygon.h"

namespace throng::crowd {

namespace {

constexpr float kMinWall = 1.5F;  // m
constexpr float kMinTurn = 0.3F;  // twice the sine of half of the angle between the walls

/// People walk on the right of a wall.
Eigen::Vector2f outward(const Segment& wall) { return {wall.direction.y(), -wall.direction.x()}; }

}  // namespace

Eigen::Vector2f CornerLane::pass(const Eigen::Vector2f& p) const {
  constexpr float kGrazing = 0.2F;  // cosine: sharper turns are passed as if they were not
  const float distance = std::max(0.0F, normal.dot(p - corner));
  return corner + distance / std::max(kGrazing, normal.dot(across)) * across;
}

std::optional<CornerLane> corner_lane(const Obstacles& obstacles, std::uint32_t class_mask,
                                      const Eigen::Vector2f& from, const Eigen::Vector2f& bend,
                                      float reach, std::vector<Obstacles::Near>& near) {
  obstacles.near(bend, reach, class_mask, near);
  const std::vector<Segment>& segments = obstacles.segments();
  for (const Obstacles::Near& candidate : near) {
    for (const int index : {candidate.segment, segments[candidate.segment].next}) {
      const Segment& second = segments[static_cast<std::size_t>(index)];
      const Segment& first = segments[static_cast<std::size_t>(second.previous)];
      if (!second.convex || (second.begin - bend).squaredNorm() > reach * reach) continue;
      const float shortest =
          std::min((first.end - first.begin).norm(), (second.end - second.begin).norm());
      if (shortest < kMinWall) continue;
      const Eigen::Vector2f across = first.direction - second.direction;
      const float size = across.norm();
      if (size < kMinTurn) continue;
      const Eigen::Vector2f come = bend - from;
      const bool is_first = std::abs(geometry::cross(first.direction, come)) <
                            std::abs(geometry::cross(second.direction, come));
      return CornerLane{second.begin, across / size, outward(is_first ? first : second)};
    }
  }
  return std::nullopt;
}

}  // namespace throng::crowd
