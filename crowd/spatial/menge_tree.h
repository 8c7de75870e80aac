// Neighbors in Menge's order, for runs that are to repeat published ones.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "crowd/agents.h"
#include "crowd/spatial/grid.h"

namespace throng::crowd {

/// Agents who stand in rows have neighbors at equal distances, and which of them comes first
/// decides where everybody turns. Menge lists them as it meets them in a tree of boxes: cut in the
/// middle of the longer side until ten agents or fewer are left, who keep the order that the cuts
/// of earlier steps brought them into; the nearer box is looked at first.
class MengeTree {
 public:
  /// Memory of a search; kept from one to the next, so that it allocates nothing.
  struct Search {
    std::vector<Grid::Neighbor> found;
    std::vector<std::pair<float, std::uint32_t>> waiting;  // square distance in m^2, node
  };

  /// Sorts the agents in the grid again. Not for several threads at once.
  void build(const Grid& grid, std::size_t agent_count);

  /// The same agents as Grid::nearest, ties in the tree's order.
  std::span<const Grid::Neighbor> nearest(const Grid& grid, std::size_t slot, float range,
                                          std::size_t max_neighbors, Search& search) const;

 private:
  struct Node {
    Eigen::Vector2f min;
    Eigen::Vector2f max;
    std::uint32_t begin = 0;  // of order_
    std::uint32_t end = 0;
    std::uint32_t left = 0;  // nodes; 0: a leaf
    std::uint32_t right = 0;
  };

  static float distance_sq(const Node& node, const Eigen::Vector2f& point);
  void cut(const Grid& grid, std::uint32_t node);
  std::uint32_t add_node(const Grid& grid, std::uint32_t begin, std::uint32_t end);

  std::vector<std::uint32_t> order_;    // ids of those in the grid
  std::vector<std::uint32_t> slot_of_;  // by id
  std::vector<Node> nodes_;
};

}  // namespace throng::crowd
