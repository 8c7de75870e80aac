// The time-to-collision law for a batch of agents, one agent per lane of a vector.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/compute/instruction_set.h"
#include "crowd/models/lane_batch.h"
#include "crowd/spatial/grid.h"

namespace throng::crowd {

/// Constants of the law (`ttc_model()` describes them).
struct TtcConstants {
  float strength_m2 = 0;
  float horizon_s = 0;
  float relaxation_s = 0;
  float reach_m = 0;
  float half_density_per_m2 = 0;
  float steepness_m2 = 0;
  float jam_share = 0;
  float jam_decline_per_m2 = 0;
  float perception_s = 0;
  float foresight_s = 0;
  float alongside_share = 0;
  float caution = 0;
  float caution_density_per_m2 = 0;
  float keep_right_m2 = 0;
  float spread_m2 = 0;
  float max_spread = 0;
  float clearance_m = 0;
  float relief = 0;
};

/// The part of an agent's state besides its body that neighbors see; kernels load it as four
/// floats.
struct Intent {
  Eigen::Vector2f direction;  ///< preferred, unit
  float walks = 0;            ///< 1: wants to go; 0: stands
  float unused = 0;
};

/// A batch of agents and their results, reused for successive batches.
class TtcBatch {
 public:
  using Lanes = LaneBatch::Lanes;

  /// One agent.
  struct View {
    std::size_t slot = 0;
    std::span<const Grid::Neighbor> neighbors;
    float reach_sq_m2 = 0;  ///< of the density: others farther away are not known
    float free_mps = 0;     ///< free speed
    float max_mps = 0;      ///< preferred speed now
    float max_share = 1;    ///< of the free speed, where there is room for one only
    float enclosure = 1;    ///< how much the ground behind walls counts as taken, 0 to 1
    float care = 1;         ///< share of the avoidance that is left to those who force their way
    float perceived_per_m2 = 0;
  };

  /// Reserves memory for so many neighbors and walls per agent.
  TtcBatch(std::size_t neighbors, std::size_t walls);

  void clear() {
    agents_.clear();
    wall_count_.fill(0);
  }
  std::size_t size() const { return agents_.size(); }
  /// Adds an agent; add_wall() then adds its walls.
  void add(const View& view);
  /// Adds a wall of the last agent: its ends and its nearest point, relative to the agent.
  void add_wall(const Eigen::Vector2f& begin, const Eigen::Vector2f& end,
                const Eigen::Vector2f& nearest, bool pushes);

  /// Results, per lane: mean velocity of the step (m/s), density that the agent perceives, speed
  /// that it would have without collisions.
  Eigen::Vector2f velocity(std::size_t lane) const {
    return {velocity_x_[lane], velocity_y_[lane]};
  }
  float perceived_per_m2(std::size_t lane) const { return perceived_[lane]; }
  float wished_mps(std::size_t lane) const { return wished_mps_[lane]; }

  /// A neighbor of each agent.
  struct Row {
    Lanes x{};  // offset from the agent, m
    Lanes y{};
    Lanes vx{};
    Lanes vy{};
    Lanes touch{};    // distance of the centers at contact, m
    Lanes against{};  // 0: the other walks the same way, 1: comes towards the agent
    Lanes weight{};   // of the force between the two if the other is in view
  };
  struct WallRow {
    Lanes x{};  // nearest point, from the agent, m
    Lanes y{};
  };

  /// Inputs of a step besides the batch.
  struct Setting {
    const Grid& grid;
    std::span<const Intent> intents;  ///< by slot of the grid
    const TtcConstants& constants;
    float dt_s = 0;
  };
  using Solve = void(const Setting&, TtcBatch&);
  static Solve* pick(InstructionSet set);

 private:
  friend struct TtcKernel;

  struct Segment {
    Eigen::Vector2f begin;
    Eigen::Vector2f edge;
  };

  LaneBatch agents_;
  std::vector<Row> rows_;
  std::vector<WallRow> walls_;
  std::vector<Row> busy_rows_;  // of agents whose lanes are gathered
  std::vector<WallRow> busy_walls_;
  std::array<std::int32_t, LaneBatch::kAgents> wall_count_{};
  std::array<std::vector<Segment>, LaneBatch::kAgents> segments_;
  Lanes reach_sq_{};
  Lanes free_mps_{};
  Lanes max_mps_{};
  Lanes max_share_{};
  Lanes enclosure_{};
  Lanes care_{};
  Lanes perceived_{};
  Lanes wished_mps_{};
  Lanes velocity_x_{};
  Lanes velocity_y_{};
};

}  // namespace throng::crowd
