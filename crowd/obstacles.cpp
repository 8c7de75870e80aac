#include "crowd/obstacles.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "base/error.h"

namespace throng::crowd {

namespace {

constexpr int kLeafSize = 4;

Eigen::Vector2f middle(const Segment& segment) { return 0.5F * (segment.begin + segment.end); }

}  // namespace

Eigen::Vector2f nearest_on_segment(const Eigen::Vector2f& a, const Eigen::Vector2f& b,
                                   const Eigen::Vector2f& p) {
  const Eigen::Vector2f edge = b - a;
  const float length_sq = edge.squaredNorm();
  if (length_sq == 0) return a;
  const float t = std::clamp((p - a).dot(edge) / length_sq, 0.0F, 1.0F);
  return a + t * edge;
}

void Obstacles::add_polygon(std::span<const Eigen::Vector2f> corners,
                            std::uint32_t obstacle_class) {
  const int first = static_cast<int>(segments_.size());
  const int count = static_cast<int>(corners.size());
  check(count >= 3, "an obstacle has three corners or more");
  for (int i = 0; i < count; ++i) {
    const int next = (i + 1) % count;
    const int previous = (i + count - 1) % count;
    Segment segment;
    segment.begin = corners[i];
    segment.end = corners[next];
    segment.direction = (segment.end - segment.begin).normalized();
    segment.previous = first + previous;
    segment.next = first + next;
    segment.convex = cross(corners[i] - corners[previous], corners[next] - corners[i]) >= 0;
    segment.obstacle_class = obstacle_class;
    segments_.push_back(segment);
  }
}

void Obstacles::build() {
  order_.resize(segments_.size());
  std::iota(order_.begin(), order_.end(), 0);
  nodes_.clear();
  if (!order_.empty()) build_node(0, static_cast<int>(order_.size()));
}

void Obstacles::build_node(int begin, int end) {
  const std::size_t index = nodes_.size();
  Node node;
  node.begin = begin;
  node.end = end;
  node.min = node.max = segments_[order_[begin]].begin;
  for (int i = begin; i < end; ++i) {
    const Segment& segment = segments_[order_[i]];
    node.min = node.min.cwiseMin(segment.begin).cwiseMin(segment.end);
    node.max = node.max.cwiseMax(segment.begin).cwiseMax(segment.end);
  }
  nodes_.push_back(node);
  if (end - begin <= kLeafSize) return;
  const Eigen::Vector2f extent = node.max - node.min;
  const int axis = extent.x() >= extent.y() ? 0 : 1;
  std::sort(order_.begin() + begin, order_.begin() + end, [&](int a, int b) {
    const float at_a = middle(segments_[a])[axis];
    const float at_b = middle(segments_[b])[axis];
    return at_a != at_b ? at_a < at_b : a < b;
  });
  const int split = (begin + end) / 2;
  build_node(begin, split);
  nodes_[index].second = static_cast<int>(nodes_.size());
  build_node(split, end);
}

void Obstacles::near(const Eigen::Vector2f& point, float range, std::uint32_t class_mask,
                     std::vector<Near>& found) const {
  found.clear();
  if (nodes_.empty()) return;
  const float range_sq = range * range;
  std::array<int, 64> stack{};  // halving 2^31 segments takes fewer levels
  std::size_t waiting = 0;
  stack[waiting++] = 0;
  while (waiting > 0) {
    const int index = stack[--waiting];
    const Node& node = nodes_[index];
    const Eigen::Vector2f inside = point.cwiseMax(node.min).cwiseMin(node.max);
    if ((inside - point).squaredNorm() >= range_sq) continue;
    if (node.second != 0) {
      stack[waiting++] = index + 1;
      stack[waiting++] = node.second;
      continue;
    }
    for (int i = node.begin; i < node.end; ++i) {
      const Segment& segment = segments_[order_[i]];
      if ((segment.obstacle_class & class_mask) == 0) continue;
      if (cross(segment.direction, point - segment.begin) >= 0) continue;
      const float distance_sq =
          (nearest_on_segment(segment.begin, segment.end, point) - point).squaredNorm();
      if (distance_sq < range_sq) found.push_back({distance_sq, order_[i]});
    }
  }
  std::sort(found.begin(), found.end(), [](const Near& a, const Near& b) {
    return a.distance_sq != b.distance_sq ? a.distance_sq < b.distance_sq : a.segment < b.segment;
  });
}

}  // namespace throng::crowd
