// ORCA for several agents, one per lane: half-planes and optimal velocities.
#pragma once

#include <vector>

#include "base/compute/instruction_set.h"
#include "crowd/models/half_planes.h"
#include "crowd/models/lane_batch.h"
#include "crowd/spatial/grid.h"

namespace throng::crowd {

/// A batch of agents with their neighbors. Reused for successive batches to avoid allocations.
class OrcaBatch {
 public:
  static constexpr std::size_t kAgents = LaneBatch::kAgents;

  struct Agent {
    std::size_t slot = 0;  ///< slot of the grid
    float horizon_s = 0;
    Eigen::Vector2f preferred;  ///< preferred velocity
    float max_speed = 0;
  };

  /// Reserves memory for `neighbors` neighbors and `walls` half-planes of walls per agent.
  OrcaBatch(std::size_t neighbors, std::size_t walls);

  void clear();
  std::size_t size() const { return agents_.size(); }
  /// Adds an agent, at most kAgents in total. `walls` are half-planes that must be kept.
  void add(const Agent& agent, const HalfPlanes& walls, std::span<const Grid::Neighbor> neighbors);

  /// Returns the agents and their neighbors in the order of add(), with unused lanes filled.
  const LaneBatch& seen() {
    agents_.fill();
    return agents_;
  }
  /// Replaces time horizon and preferred velocity of the i-th agent.
  void set_wish(std::size_t i, float horizon_s, const Eigen::Vector2f& preferred) {
    cutoff_[i] = 1 / horizon_s;
    preferred_x_[i] = preferred.x();
    preferred_y_[i] = preferred.y();
  }

  /// Returns the new velocity of the i-th agent after a call of the kernel.
  Eigen::Vector2f velocity(std::size_t i) const { return {velocity_x_[i], velocity_y_[i]}; }

  /// Computes the new velocities. `dt_s` is the time within which overlapping agents separate. The
  /// result for an agent does not depend on the other agents of the batch.
  using Kernel = void(const Grid& grid, float dt_s, OrcaBatch& batch);
  static Kernel* kernel(InstructionSet set);

 private:
  friend struct OrcaKernel;
  using Lanes = LaneBatch::Lanes;

  /// A half-plane per agent.
  struct Row {
    Lanes point_x;
    Lanes point_y;
    Lanes direction_x;
    Lanes direction_y;
  };

  void make_room(std::size_t planes);

  LaneBatch agents_;
  std::size_t wall_rows_ = 0;
  Lanes cutoff_{};  // 1/s
  Lanes preferred_x_{};
  Lanes preferred_y_{};
  Lanes max_speed_{};
  Lanes walls_{};  // number of half-planes of walls
  Lanes velocity_x_{};
  Lanes velocity_y_{};
  std::vector<Row> planes_;  // those of walls, then those of neighbors
  std::vector<Row> scratch_;
};

}  // namespace throng::crowd
