#include "crowd/spatial/box_tree.h"

#include <algorithm>
#include <numeric>

namespace throng::crowd {

namespace {

constexpr int kLeafSize = 4;

}  // namespace

void BoxTree::build(const std::vector<Box>& boxes) {
  order_.resize(boxes.size());
  std::iota(order_.begin(), order_.end(), 0);
  nodes_.clear();
  if (!order_.empty()) build_node(boxes, 0, static_cast<int>(order_.size()));
}

void BoxTree::build_node(const std::vector<Box>& boxes, int begin, int end) {
  const std::size_t index = nodes_.size();
  Node node;
  node.begin = begin;
  node.end = end;
  node.box = boxes[order_[begin]];
  for (int i = begin; i < end; ++i) {
    node.box.min = node.box.min.cwiseMin(boxes[order_[i]].min);
    node.box.max = node.box.max.cwiseMax(boxes[order_[i]].max);
  }
  nodes_.push_back(node);
  if (end - begin <= kLeafSize) return;
  const Eigen::Vector2f extent = node.box.max - node.box.min;
  const int axis = extent.x() >= extent.y() ? 0 : 1;
  std::sort(order_.begin() + begin, order_.begin() + end, [&](int a, int b) {
    const float at_a = boxes[a].center()[axis];
    const float at_b = boxes[b].center()[axis];
    return at_a != at_b ? at_a < at_b : a < b;
  });
  const int split = (begin + end) / 2;
  build_node(boxes, begin, split);
  nodes_[index].second = static_cast<int>(nodes_.size());
  build_node(boxes, split, end);
}

}  // namespace throng::crowd
