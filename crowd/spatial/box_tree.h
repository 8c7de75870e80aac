// A tree of bounding boxes of static objects: walls, polygons of a mesh.
#pragma once

#include <array>
#include <vector>

#include "crowd/elements/shapes.h"

namespace throng::crowd {

/// A binary tree of boxes. Searches may run in several threads after build().
class BoxTree {
 public:
  /// Builds the tree of the boxes of objects 0, 1, ...
  void build(const std::vector<Box>& boxes);

  /// Returns the objects in the order of the leaves. Callers store objects in this order, so that
  /// near ones are near in memory.
  const std::vector<int>& order() const { return order_; }

  /// Calls visit(i) for all i for which the box of order()[i] is at most sqrt(range_sq) from the
  /// point, roughly nearest first. visit may reduce range_sq.
  template <typename Visit>
  void near(const Eigen::Vector2f& point, const float& range_sq, const Visit& visit) const;

  /// Calls visit(i) for all i whose box, enlarged by margin, may cross the segment from a to b,
  /// until visit returns true. Returns whether it did.
  template <typename Visit>
  bool any_along(const Eigen::Vector2f& a, const Eigen::Vector2f& b, float margin,
                 const Visit& visit) const;

 private:
  struct Node {
    Box box;
    int begin = 0;  // range in order_
    int end = 0;
    int second = 0;  // index of the second child; the first child follows its parent; 0: a leaf
  };
  static constexpr std::size_t kDeepest = 64;  // halving 2^31 objects takes fewer levels

  void build_node(const std::vector<Box>& boxes, int begin, int end);
  static float distance_sq(const Box& box, const Eigen::Vector2f& point) {
    return (point.cwiseMax(box.min).cwiseMin(box.max) - point).squaredNorm();
  }
  static bool may_cross(const Box& box, const Eigen::Vector2f& a, const Eigen::Vector2f& b,
                        float margin) {
    const Eigen::Vector2f low = box.min.array() - margin;
    const Eigen::Vector2f high = box.max.array() + margin;
    if ((a.cwiseMax(b).array() < low.array()).any()) return false;
    if ((a.cwiseMin(b).array() > high.array()).any()) return false;
    // Whether all corners are on the same side of the line.
    const Eigen::Vector2f normal(a.y() - b.y(), b.x() - a.x());
    const Eigen::Vector2f half = 0.5F * (high - low);
    const float middle = normal.dot(0.5F * (low + high) - a);
    return std::abs(middle) <= normal.cwiseAbs().dot(half);
  }

  std::vector<int> order_;
  std::vector<Node> nodes_;
};

template <typename Visit>
void BoxTree::near(const Eigen::Vector2f& point, const float& range_sq, const Visit& visit) const {
  if (nodes_.empty() || !(distance_sq(nodes_[0].box, point) <= range_sq)) return;
  struct Waiting {
    int node;
    float distance_sq;
  };
  std::array<Waiting, kDeepest> stack;
  std::size_t waiting = 0;
  stack[waiting++] = {0, 0};
  while (waiting > 0) {
    const Waiting next = stack[--waiting];
    if (next.distance_sq > range_sq) continue;
    const Node& node = nodes_[static_cast<std::size_t>(next.node)];
    if (node.second == 0) {
      for (int i = node.begin; i < node.end; ++i) visit(i);
      continue;
    }
    Waiting nearer{next.node + 1,
                   distance_sq(nodes_[static_cast<std::size_t>(next.node) + 1].box, point)};
    Waiting farther{node.second,
                    distance_sq(nodes_[static_cast<std::size_t>(node.second)].box, point)};
    if (farther.distance_sq < nearer.distance_sq) std::swap(nearer, farther);
    if (farther.distance_sq <= range_sq) stack[waiting++] = farther;
    if (nearer.distance_sq <= range_sq) stack[waiting++] = nearer;
  }
}

template <typename Visit>
bool BoxTree::any_along(const Eigen::Vector2f& a, const Eigen::Vector2f& b, float margin,
                        const Visit& visit) const {
  if (nodes_.empty()) return false;
  std::array<int, kDeepest> stack{};
  std::size_t waiting = 0;
  stack[waiting++] = 0;
  while (waiting > 0) {
    const int index = stack[--waiting];
    const Node& node = nodes_[static_cast<std::size_t>(index)];
    if (!may_cross(node.box, a, b, margin)) continue;
    if (node.second != 0) {
      stack[waiting++] = node.second;
      stack[waiting++] = index + 1;
      continue;
    }
    for (int i = node.begin; i < node.end; ++i) {
      if (visit(i)) return true;
    }
  }
  return false;
}

}  // namespace throng::crowd
