#include "crowd/navigation/corner_lane.h"

#include <algorithm>
#include <cmath>

#include "base/geometry/polygon.h"

namespace throng::crowd {

namespace {

using Eigen::Vector2f;
using geometry::cross;

constexpr float kMinWall = 1.5F;  // m
constexpr float kMinTurn = 0.3F;  // sine of the angle between the walls
constexpr float kFar = 10;        // m: where there is more room than that, it does not matter

/// People walk on the right of a wall.
Vector2f outward(const Segment& wall) { return {wall.direction.y(), -wall.direction.x()}; }

/// The walls near a place, nearest first.
class Walls {
 public:
  Walls(const Obstacles& obstacles, const std::vector<Obstacles::Near>& near)
      : segments_(obstacles.segments()), near_(near) {}

  std::size_t count() const { return near_.size(); }
  float distance_sq(std::size_t i) const { return near_[i].distance_sq; }
  const Segment& operator[](std::size_t i) const {
    return segments_[static_cast<std::size_t>(near_[i].segment)];
  }

  /// Whether a wall and others in line with it go on for long from a point of its line, but for
  /// gaps of this width.
  bool is_long(const Segment& wall, const Vector2f& from, const Vector2f& direction,
               float gap_m) const {
    constexpr float kInLine = 0.05F;  // m
    float reached = 0;
    for (bool further = true; further && reached < kMinWall;) {
      further = false;
      for (std::size_t i = 0; i < count(); ++i) {
        const Segment& piece = (*this)[i];
        const Vector2f begin = piece.begin - from;
        const Vector2f end = piece.end - from;
        if (piece.direction.dot(wall.direction) <= 0 ||
            std::abs(cross(direction, begin)) > kInLine ||
            std::abs(cross(direction, end)) > kInLine) {
          continue;
        }
        const auto [low, high] = std::minmax({direction.dot(begin), direction.dot(end)});
        if (low > reached + gap_m || high <= reached) continue;
        reached = high;
        further = true;
      }
    }
    return reached >= kMinWall;
  }

  /// How far one can go from a point.
  float free_m(const Vector2f& from, const Vector2f& direction) const {
    float free = kFar;
    for (std::size_t i = 0; i < count(); ++i) {
      const Segment& wall = (*this)[i];
      const Vector2f edge = wall.end - wall.begin;
      const float across = cross(direction, edge);
      if (across >= 0) continue;  // along the wall or out of it
      const Vector2f to = wall.begin - from;
      const float distance = cross(to, edge) / across;
      const float share = cross(to, direction) / across;
      if (distance >= 0 && share >= 0 && share <= 1) free = std::min(free, distance);
    }
    return free;
  }

 private:
  const std::vector<Segment>& segments_;
  const std::vector<Obstacles::Near>& near_;
};

/// The corner of two walls, if a path turns around it to this side (1: left, -1: right).
std::optional<CornerLane> lane_around(const Walls& before, const Segment& first,
                                      const Walls& behind, const Segment& second, float side,
                                      const PathTurn& turn, float radius) {
  const Vector2f in = side * first.direction;
  const Vector2f out = side * second.direction;
  const float sine = cross(in, out);
  if (side * sine < kMinTurn) return std::nullopt;
  if (outward(first).dot(turn.from - first.begin) <= 0) return std::nullopt;
  if (outward(second).dot(turn.after - second.begin) <= 0) return std::nullopt;
  const Vector2f corner = first.begin + cross(second.begin - first.begin, out) / sine * in;
  if ((corner - turn.bend).norm() > corner_reach_m(radius)) return std::nullopt;
  if (!before.is_long(first, corner, -in, 2 * radius)) return std::nullopt;
  if (!behind.is_long(second, corner, out, 2 * radius)) return std::nullopt;
  const Vector2f across = (in - out).normalized();
  constexpr float kBeside = 0.5F;  // m from the corner
  const float room_before = before.free_m(corner - kBeside * in, outward(first));
  const float room_behind = behind.free_m(corner + kBeside * out, outward(second));
  constexpr float kFunnel = 0.5F;
  if (room_behind < kFunnel * room_before) return std::nullopt;
  return CornerLane{corner, across, side * Vector2f(-across.y(), across.x()), outward(first),
                    std::min(1.0F, room_behind / room_before)};
}

}  // namespace

Vector2f CornerLane::pass(const Vector2f& p) const {
  constexpr float kSharp = 0.7F;  // cosine: sharper turns than about 90 degrees are rounded
  const float distance = std::max(0.0F, normal.dot(p - corner));
  return corner + narrowing * distance / std::max(kSharp, normal.dot(across)) * across;
}

std::optional<CornerLane> corner_lane(const Obstacles& obstacles, std::uint32_t class_mask,
                                      const PathTurn& turn, float radius, CornerWalls& buffers) {
  const float reach_sq = corner_reach_m(radius) * corner_reach_m(radius);
  // From beside the walls, which a bend need not be.
  const Vector2f come = (turn.bend - turn.from).normalized();
  const Vector2f go = (turn.after - turn.leave).normalized();
  obstacles.near(turn.bend - radius * come, kFar, class_mask, buffers.before);
  obstacles.near(turn.leave + radius * go, kFar, class_mask, buffers.behind);
  const Walls before(obstacles, buffers.before);
  const Walls behind(obstacles, buffers.behind);
  const float side = cross(come, go) > 0 ? 1.0F : -1.0F;
  for (std::size_t i = 0; i < before.count() && before.distance_sq(i) < reach_sq; ++i) {
    for (std::size_t k = 0; k < behind.count() && behind.distance_sq(k) < reach_sq; ++k) {
      auto lane = lane_around(before, before[i], behind, behind[k], side, turn, radius);
      if (lane) return lane;
    }
  }
  return std::nullopt;
}

}  // namespace throng::crowd
