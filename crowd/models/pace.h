// Speed regulation of the model `weidmann` in a crowd.
#pragma once

#include <span>

#include "base/compute/instruction_set.h"
#include "crowd/models/lane_batch.h"
#include "crowd/state/neighborhood.h"

namespace throng::crowd {

/// Parameters of Pace; docs/crowd.md describes their calibration.
struct PaceSpec {
  float reach_m = 1.7F;           ///< distance ahead within which others count
  float jam_density = 4.82F;      ///< 1/m^2
  float decline = 1.56F;          ///< 1/m^2
  float min_speed_share = 0.19F;  ///< min fraction of the free speed, in a jam
  float headway_s = 0.85F;        ///< time gap to the person ahead, in single file
  float keep_right = 6;           ///< rad m^2: turn by the density of oncoming people
};

/// The reaction of an agent to people ahead.
struct SpeedRegulation {
  float share = 1;            ///< fraction of the free speed, at most 1
  float horizon_share = 1;    ///< fraction of the time horizon
  Eigen::Vector2f direction;  ///< unit vector; replaces the direction to the goal
};

/// Limits the speed by the density ahead with Weidmann's fundamental diagram (1993, Schriftenreihe
/// des IVT 90): v0 (1 - exp(-decline (1/density - 1/jam_density))), at least min_speed_share v0, so
/// that a crowd does not lock. v0 is the agent's free speed.
///
/// If walls leave room for single file only, speed is also at most the gap to the person ahead
/// divided by headway_s, because the relation in single file is linear (Seyfried et al. 2005, J.
/// Stat. Mech. P10002).
///
/// Oncoming people do not reduce the speed. The agent turns right by 2 atan(keep_right density /
/// 2), at most 1 rad, and uses a longer time horizon; this forms lanes.
class Pace {
 public:
  explicit Pace(const PaceSpec& spec) : spec_(spec) {}

  /// View of an agent, except the density ahead.
  struct View {
    Eigen::Vector2f direction;  ///< unit vector: preferred direction
    float free_speed = 0;       ///< m/s
    float reach_sq = 0;         ///< m^2: square of the distance within which others count
    float file_share = 1;       ///< max fraction of the free speed in single file
  };
  View view(const Crowd& crowd, const Grid& grid, const AgentView& around) const;

  /// Density (1/m^2) in the half disc ahead. People at distance d and angle a count (1 - d^2/R^2)
  /// cos(a). R is the reach, or the distance of the farthest neighbor if the agent has its max
  /// number of neighbors.
  struct Ahead {
    float along = 0;    ///< people who are not oncoming, 1/m^2
    float against = 0;  ///< oncoming people, 1/m^2
  };

  SpeedRegulation regulation(const View& view, const Ahead& ahead) const;

 private:
  PaceSpec spec_;
};

/// Densities ahead of several agents, one per lane.
class PaceBatch {
 public:
  void set(std::size_t lane, const Pace::View& view) { views_[lane] = view; }
  const Pace::View& view(std::size_t lane) const { return views_[lane]; }
  /// Returns the result after a call of the kernel.
  Pace::Ahead ahead(std::size_t lane) const { return {along_[lane], against_[lane]}; }

  /// Computes the densities. `directions`: preferred directions, indexed by slot of the grid.
  /// `agents`: the agents of the batch with their neighbors, after fill(). The result for an agent
  /// does not depend on the other agents of the batch.
  using Kernel = void(const Grid& grid, std::span<const Eigen::Vector2f> directions,
                      const LaneBatch& agents, PaceBatch& batch);
  static Kernel* kernel(InstructionSet set);

 private:
  friend struct PaceKernel;

  std::array<Pace::View, LaneBatch::kAgents> views_;
  LaneBatch::Lanes along_{};
  LaneBatch::Lanes against_{};
};

}  // namespace throng::crowd
