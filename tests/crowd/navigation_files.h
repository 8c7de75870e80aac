// Worlds with walls for the tests of paths around them.
#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <vector>

#include "base/compute/random.h"
#include "crowd/spatial/obstacles.h"

namespace throng::crowd::test {

inline std::array<Eigen::Vector2f, 4> box_corners(const Box& box) {
  return {{box.min, {box.max.x(), box.min.y()}, box.max, {box.min.x(), box.max.y()}}};
}

inline std::string obstacle(const Box& box) {
  std::string text = R"(<Obstacle closed="1">)";
  for (const Eigen::Vector2f& corner : box_corners(box)) {
    text += fmt::format(R"(<Vertex p_x="{}" p_y="{}"/>)", corner.x(), corner.y());
  }
  return text + "</Obstacle>";
}

inline std::string obstacles(const std::vector<Box>& boxes) {
  std::string text = R"(<ObstacleSet type="explicit" class="1">)";
  for (const Box& box : boxes) text += obstacle(box);
  return text + "</ObstacleSet>";
}

/// Boxes in a square of this size, from (0, 0) on.
inline std::vector<Box> random_boxes(int count, float size, std::uint64_t seed) {
  std::vector<Box> boxes;
  for (int i = 0; i < count; ++i) {
    Random random(seed, Stream::crowd_generator, static_cast<std::uint64_t>(i));
    const auto draw = [&](double low, double high) {
      return size * static_cast<float>(random.uniform(low, high));
    };
    const Eigen::Vector2f min(draw(0, 1), draw(0, 1));
    boxes.push_back({min, min + Eigen::Vector2f(draw(0.02, 0.12), draw(0.02, 0.12))});
  }
  return boxes;
}

inline Box grown(const Box& box, float by) { return {box.min.array() - by, box.max.array() + by}; }

/// Whether the open box lies across the segment from a to b.
inline bool blocks(const Box& box, const Eigen::Vector2f& a, const Eigen::Vector2f& b) {
  constexpr float kTouch = 1e-3F;
  float enter = 0;
  float leave = 1;
  for (int axis = 0; axis < 2; ++axis) {
    const float low = box.min[axis] + kTouch - a[axis];
    const float high = box.max[axis] - kTouch - a[axis];
    const float way = b[axis] - a[axis];
    if (std::abs(way) < 1e-9F) {
      if (low >= 0 || high <= 0) return false;
      continue;
    }
    enter = std::max(enter, std::min(low / way, high / way));
    leave = std::min(leave, std::max(low / way, high / way));
  }
  return enter < leave;
}

inline bool sees(const std::vector<Box>& boxes, const Eigen::Vector2f& a,
                 const Eigen::Vector2f& b) {
  return std::none_of(boxes.begin(), boxes.end(),
                      [&](const Box& box) { return blocks(box, a, b); });
}

/// The length of the shortest path around boxes, by Dijkstra's algorithm on their corners; infinite
/// when there is none.
inline float shortest_path(const std::vector<Box>& boxes, const Eigen::Vector2f& from,
                           const Eigen::Vector2f& to) {
  std::vector<Eigen::Vector2f> places = {from};
  for (const Box& box : boxes) {
    for (const Eigen::Vector2f& corner : box_corners(box)) places.push_back(corner);
  }
  places.push_back(to);
  constexpr float kFar = std::numeric_limits<float>::infinity();
  std::vector<float> length(places.size(), kFar);
  std::vector<bool> done(places.size(), false);
  length[0] = 0;
  for (;;) {
    std::size_t next = places.size();
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (!done[i] && length[i] < kFar && (next == places.size() || length[i] < length[next])) {
        next = i;
      }
    }
    if (next == places.size()) return kFar;
    if (next + 1 == places.size()) return length[next];
    done[next] = true;
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (done[i]) continue;
      const float by_next = length[next] + (places[i] - places[next]).norm();
      if (by_next < length[i] && sees(boxes, places[next], places[i])) length[i] = by_next;
    }
  }
}

}  // namespace throng::crowd::test
