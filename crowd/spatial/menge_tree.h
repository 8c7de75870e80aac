// Neighbors in Menge's order, for runs that reproduce published ones.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "crowd/agents/agents.h"
#include "crowd/spatial/grid.h"

namespace throng::crowd {

/// Agents in rows have neighbors at equal distances, and their order influences the model. Menge
/// orders them by a tree of boxes that are divided in the middle of the longer side until at most
/// ten agents are left. The agents of a leaf keep the order of earlier divisions; the nearer box is
/// searched first.
class MengeTree {
 public:
  /// Buffers of a search, reused to avoid allocations; one per thread.
  struct Search {
    std::vector<Grid::Neighbor> found;
    std::vector<std::pair<float, std::uint32_t>> waiting;  // square distance in m^2, and node
  };

  /// Builds the tree of the agents in the grid. Not thread-safe.
  void build(const Grid& grid, std::size_t agent_count);

  /// Returns the agents of Grid::nearest(); agents at equal distances are in the order of the tree.
  std::span<const Grid::Neighbor> nearest(const Grid& grid, std::size_t slot, float range,
                                          std::size_t max_neighbors, Search& search) const;

 private:
  struct Node {
    Eigen::Vector2f min;
    Eigen::Vector2f max;
    std::uint32_t begin = 0;  // range in order_
    std::uint32_t end = 0;
    std::uint32_t left = 0;  // index of a node; 0: a leaf
    std::uint32_t right = 0;
  };

  static float distance_sq(const Node& node, const Eigen::Vector2f& point);
  void cut(const Grid& grid, std::uint32_t node);
  std::uint32_t add_node(const Grid& grid, std::uint32_t begin, std::uint32_t end);

  std::vector<std::uint32_t> order_;    // ids of the agents in the grid
  std::vector<std::uint32_t> slot_of_;  // indexed by id
  std::vector<Node> nodes_;
};

}  // namespace throng::crowd
