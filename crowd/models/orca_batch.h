// ORCA for several agents at once, one per lane: their half-planes and the best velocities.
#pragma once

#include <vector>

#include "base/compute/instruction_set.h"
#include "crowd/models/half_planes.h"
#include "crowd/models/lane_batch.h"
#include "crowd/spatial/grid.h"

namespace throng::crowd {

/// A few agents and what they see. Kept from batch to batch, so that nothing is allocated.
class OrcaBatch {
 public:
  static constexpr std::size_t kAgents = LaneBatch::kAgents;

  struct Agent {
    std::size_t slot = 0;  ///< in the grid
    float horizon_s = 0;
    Eigen::Vector2f preferred;  ///< velocity
    float max_speed = 0;
  };

  /// Room for so many at first.
  OrcaBatch(std::size_t neighbors, std::size_t walls);

  void clear();
  std::size_t size() const { return agents_.size(); }
  /// Adds one of at most kAgents; `walls` are half-planes that it has to keep.
  void add(const Agent& agent, const HalfPlanes& walls, std::span<const Grid::Neighbor> neighbors);

  /// The agents seen, in the order in which they were added; lanes without one are filled.
  const LaneBatch& seen() {
    agents_.fill();
    return agents_;
  }
  /// Has an agent that was added want something else.
  void set_wish(std::size_t i, float horizon_s, const Eigen::Vector2f& preferred) {
    cutoff_[i] = 1 / horizon_s;
    preferred_x_[i] = preferred.x();
    preferred_y_[i] = preferred.y();
  }

  /// The new velocity of the i-th agent that was added, once a kernel has run.
  Eigen::Vector2f velocity(std::size_t i) const { return {velocity_x_[i], velocity_y_[i]}; }

  /// Computes the velocities; `dt_s` is the time within which those part who overlap. An agent's
  /// does not depend on who else is in the batch.
  using Kernel = void(const Grid& grid, float dt_s, OrcaBatch& batch);
  static Kernel* kernel(InstructionSet set);

 private:
  friend struct OrcaKernel;
  using Lanes = LaneBatch::Lanes;

  /// Half-planes of all agents.
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
  Lanes walls_{};  // how many
  Lanes velocity_x_{};
  Lanes velocity_y_{};
  std::vector<Row> planes_;  // of walls, then of others
  std::vector<Row> scratch_;
};

}  // namespace throng::crowd
