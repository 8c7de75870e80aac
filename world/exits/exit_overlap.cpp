#include "world/exits/exit_overlap.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/geometry/polygon.h"

namespace throng::world {

using Eigen::Vector2d;

namespace {

constexpr double kTouchM = 0.05;

/// The part of a segment, as shares of its length, where a coordinate that goes from `a` to `b`
/// lies between two values.
struct Shares {
  double from = 0;
  double to = 1;

  void clip(double a, double b, double low, double high) {
    if (a == b) {
      if (a < low || a > high) to = -1;
      return;
    }
    const double one = (low - a) / (b - a);
    const double other = (high - a) / (b - a);
    from = std::max(from, std::min(one, other));
    to = std::min(to, std::max(one, other));
  }
};

/// The part of another door that a straight walk out of one door meets.
struct Behind {
  double width_m = 0;     ///< of the door that one leaves by
  double distance_m = 0;  ///< the least from there
};

Behind behind(const Exit& door, const Exit& other) {
  // A crossing counts from 0.2 m beyond a door's line, so that much before it makes no difference.
  constexpr double kBeyondM = 0.2;
  constexpr double kCosineOf30Degrees = 0.866;
  const bool is_parallel = std::abs(door.outward.dot(other.outward)) > kCosineOf30Degrees;
  const Vector2d along = (door.to - door.from).normalized();
  const auto in_door = [&](const Vector2d& point) {
    return Vector2d((point - door.from).dot(along), (point - door.from).dot(door.outward));
  };
  const Vector2d a = in_door(other.from);
  const Vector2d b = in_door(other.to);
  Shares part;
  part.clip(a.x(), b.x(), 0, door.width_m());
  part.clip(a.y(), b.y(), is_parallel ? -kBeyondM : 0, kExitDepthM);
  if (part.to <= part.from) return {};
  const double one = a.y() + part.from * (b.y() - a.y());
  const double end = a.y() + part.to * (b.y() - a.y());
  return {(part.to - part.from) * std::abs(b.x() - a.x()),
          one * end <= 0 ? 0 : std::min(std::abs(one), std::abs(end))};
}

/// The door without the ends that others may touch.
std::pair<Vector2d, Vector2d> trimmed(const Exit& door) {
  const Vector2d end = std::min(kTouchM / door.width_m(), 0.25) * (door.to - door.from);
  return {door.from + end, door.to - end};
}

std::optional<std::string> describe_overlap(const Exit& a, const Exit& b) {
  const auto [a_from, a_to] = trimmed(a);
  const auto [b_from, b_to] = trimmed(b);
  constexpr double kSineOf3Degrees = 0.0523;  // what is flatter lies on the other
  if (std::abs(geometry::cross(a.outward, b.outward)) > kSineOf3Degrees &&
      geometry::segments_cross(a_from, a_to, b_from, b_to)) {
    return fmt::format("exit \"{}\", which crosses exit \"{}\"", b.id, a.id);
  }
  const Behind after_a = behind(a, b);
  const Behind after_b = behind(b, a);
  const bool b_is_behind = after_a.width_m >= after_b.width_m;
  const Behind& met = b_is_behind ? after_a : after_b;
  if (met.width_m <= kTouchM) return std::nullopt;
  if (met.distance_m < kTouchM) {
    return fmt::format("exit \"{}\", of which {:.2g} m lie on exit \"{}\"", b.id, met.width_m,
                       a.id);
  }
  const Exit& front = b_is_behind ? a : b;
  const Exit& back = b_is_behind ? b : a;
  return fmt::format("exit \"{}\", which lies {:.2g} m behind exit \"{}\" over {:.2g} m", back.id,
                     met.distance_m, front.id, met.width_m);
}

}  // namespace

std::vector<ExitOverlap> overlapping_exits(const std::vector<Exit>& exits) {
  std::vector<ExitOverlap> overlaps;
  for (std::size_t j = 0; j < exits.size(); ++j) {
    for (std::size_t i = 0; i < j; ++i) {
      if (auto found = describe_overlap(exits[i], exits[j])) {
        overlaps.push_back({i, j, std::move(*found)});
      }
    }
  }
  return overlaps;
}

}  // namespace throng::world
