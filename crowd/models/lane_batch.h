// A batch of agents and their neighbors, one agent per lane of a vector.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "crowd/spatial/grid.h"

namespace throng::crowd {

/// Reused for successive batches to avoid allocations. Results for an agent must not depend on the
/// other agents of the batch.
class LaneBatch {
 public:
  static constexpr std::size_t kAgents = 32;  ///< a multiple of all numbers of lanes
  using Lanes = std::array<float, kAgents>;
  using Slots = std::array<std::uint32_t, kAgents>;  ///< slots of the grid

  /// Reserves memory for `neighbors` neighbors per agent.
  explicit LaneBatch(std::size_t neighbors) : others_(neighbors) {}

  std::size_t size() const { return size_; }
  /// Max number of neighbors of an agent in the batch.
  std::size_t rows() const { return rows_; }
  void clear() { size_ = rows_ = 0; }

  /// Adds an agent, at most kAgents in total. Returns its lane.
  std::size_t add(std::size_t slot, std::span<const Grid::Neighbor> neighbors) {
    if (others_.size() < neighbors.size()) others_.resize(neighbors.size());
    slots_[size_] = static_cast<std::uint32_t>(slot);
    neighbors_[size_] = static_cast<float>(neighbors.size());
    for (std::size_t i = 0; i < neighbors.size(); ++i) others_[i][size_] = neighbors[i].slot;
    rows_ = std::max(rows_, neighbors.size());
    return size_++;
  }
  /// Must be called after the last add(): gives unused lanes the first agent, without neighbors.
  void fill() {
    for (std::size_t lane = size_; lane < kAgents; ++lane) {
      slots_[lane] = slots_[0];
      neighbors_[lane] = 0;
    }
  }

  const Slots& slots() const { return slots_; }
  const Lanes& neighbors() const { return neighbors_; }  ///< number of neighbors, per lane
  /// Returns the i-th neighbors of the agents in kWidth lanes from `first` on, or the agent itself
  /// if it has none.
  template <int kWidth>
  std::array<std::uint32_t, kWidth> row(std::size_t i, std::size_t first) const {
    std::array<std::uint32_t, kWidth> others{};
    for (std::size_t lane = 0; lane < kWidth; ++lane) {
      const bool there = neighbors_[first + lane] > static_cast<float>(i);
      others[lane] = there ? others_[i][first + lane] : slots_[first + lane];
    }
    return others;
  }

 private:
  std::size_t size_ = 0;
  std::size_t rows_ = 0;
  Slots slots_{};
  Lanes neighbors_{};
  std::vector<Slots> others_;
};

}  // namespace throng::crowd
