#include "crowd/spatial/menge_tree.h"

#include <algorithm>

namespace throng::crowd {

namespace {

constexpr std::uint32_t kLeafSize = 10;

}  // namespace

void MengeTree::build(const Grid& grid, std::size_t agent_count) {
  slot_of_.resize(agent_count);
  for (std::size_t slot = 0; slot < grid.size(); ++slot) {
    slot_of_[grid.id(slot)] = static_cast<std::uint32_t>(slot);
  }
  if (order_.size() != grid.size()) {  // somebody came or left
    order_.resize(grid.size());
    for (std::size_t slot = 0; slot < grid.size(); ++slot) order_[slot] = grid.id(slot);
    std::sort(order_.begin(), order_.end());
  }
  nodes_.clear();
  nodes_.reserve(2 * order_.size() + 1);
  if (order_.empty()) return;
  add_node(grid, 0, static_cast<std::uint32_t>(order_.size()));
  for (std::uint32_t node = 0; node < nodes_.size(); ++node) cut(grid, node);
}

std::uint32_t MengeTree::add_node(const Grid& grid, std::uint32_t begin, std::uint32_t end) {
  Node node;
  node.begin = begin;
  node.end = end;
  node.min = node.max = grid.position(slot_of_[order_[begin]]);
  for (std::uint32_t i = begin + 1; i < end; ++i) {
    const Eigen::Vector2f& place = grid.position(slot_of_[order_[i]]);
    node.min = node.min.cwiseMin(place);
    node.max = node.max.cwiseMax(place);
  }
  nodes_.push_back(node);
  return static_cast<std::uint32_t>(nodes_.size() - 1);
}

void MengeTree::cut(const Grid& grid, std::uint32_t index) {
  const Node node = nodes_[index];
  if (node.end - node.begin <= kLeafSize || node.min == node.max) return;
  const Eigen::Vector2f extent = node.max - node.min;
  const int axis = extent.x() > extent.y() ? 0 : 1;
  const float middle = 0.5F * (node.max[axis] + node.min[axis]);
  const auto below = [&](std::uint32_t i) {
    return grid.position(slot_of_[order_[i]])[axis] < middle;
  };
  // From both ends, exchanging those who are on the wrong side: others keep their order.
  std::uint32_t low = node.begin;
  std::uint32_t high = node.end;
  while (low < high) {
    while (low < high && below(low)) ++low;
    while (low < high && !below(high - 1)) --high;
    if (low < high) std::swap(order_[low++], order_[--high]);
  }
  const std::uint32_t split = std::clamp(low, node.begin + 1, node.end - 1);
  const std::uint32_t left = add_node(grid, node.begin, split);
  const std::uint32_t right = add_node(grid, split, node.end);
  nodes_[index].left = left;
  nodes_[index].right = right;
}

float MengeTree::distance_sq(const Node& node, const Eigen::Vector2f& point) {
  const Eigen::Vector2f inside = point.cwiseMax(node.min).cwiseMin(node.max);
  return (inside - point).squaredNorm();
}

std::span<const Grid::Neighbor> MengeTree::nearest(const Grid& grid, std::size_t slot, float range,
                                                   std::size_t max_neighbors,
                                                   Search& search) const {
  std::vector<Grid::Neighbor>& found = search.found;
  found.clear();
  search.waiting.clear();
  if (max_neighbors == 0 || nodes_.empty()) return found;
  const Eigen::Vector2f& here = grid.position(slot);
  float range_sq = range * range;
  search.waiting.emplace_back(distance_sq(nodes_[0], here), 0);
  while (!search.waiting.empty()) {
    const auto [node_distance_sq, index] = search.waiting.back();
    search.waiting.pop_back();
    if (node_distance_sq >= range_sq) continue;
    const Node& node = nodes_[index];
    if (node.left != 0) {
      const float left = distance_sq(nodes_[node.left], here);
      const float right = distance_sq(nodes_[node.right], here);
      // The last one waiting comes first: the nearer, the right one if they are equally near.
      if (left >= right) search.waiting.emplace_back(left, node.left);
      search.waiting.emplace_back(right, node.right);
      if (left < right) search.waiting.emplace_back(left, node.left);
      continue;
    }
    for (std::uint32_t i = node.begin; i < node.end; ++i) {
      const std::uint32_t other = slot_of_[order_[i]];
      if (other == slot) continue;
      const float there_sq = (here - grid.position(other)).squaredNorm();
      if (there_sq >= range_sq) continue;
      if (found.size() == max_neighbors) found.pop_back();
      const auto place = std::upper_bound(
          found.begin(), found.end(), there_sq,
          [](float distance, const Grid::Neighbor& n) { return distance < n.distance_sq; });
      found.insert(place, {there_sq, other});
      if (found.size() == max_neighbors) range_sq = found.back().distance_sq;
    }
  }
  return found;
}

}  // namespace throng::crowd
