// How people of the model `weidmann` walk where it is crowded ahead of them.
#pragma once

#include <span>

#include "base/compute/instruction_set.h"
#include "crowd/models/lane_batch.h"
#include "crowd/spatial/neighborhood.h"

namespace throng::crowd {

/// Parameters of Pace. How they came about: docs/crowd.md.
struct PaceSpec {
  float reach_m = 1.7F;           ///< how far ahead others count
  float jam_density = 4.82F;      ///< 1/m^2
  float decline = 1.56F;          ///< 1/m^2
  float min_speed_share = 0.19F;  ///< share of the free speed that is left in a jam
  float headway_s = 0.85F;        ///< from touching the one ahead, in single file
  float keep_right = 6;           ///< rad m^2: turn by the density of those who come towards one
};

/// An agent's reaction to those ahead.
struct SpeedRegulation {
  float share = 1;            ///< of the free speed, at most 1
  float horizon_share = 1;    ///< of how far ahead one looks in time
  Eigen::Vector2f direction;  ///< unit: where to go instead of straight to the goal
};

/// Limits the preferred speed by the density ahead as Weidmann's fundamental diagram has it (1993,
/// Schriftenreihe des IVT 90): v0 (1 - exp(-decline (1/density - 1/jam_density))), but never below
/// least v0, so that no crowd locks. v0 is the agent's free speed.
///
/// Where walls leave no room to walk abreast, speed also is at most the gap to the one ahead by
/// headway_s: the relation in single file is linear (Seyfried et al. 2005, J. Stat. Mech. P10002).
///
/// Those who want to go the other way do not slow one down: one turns right by
/// 2 atan(keep_right density / 2), at most by 1 rad, and looks ahead farther, which is how lanes
/// form.
class Pace {
 public:
  explicit Pace(const PaceSpec& spec) : spec_(spec) {}

  /// One agent's view of the others, besides the density ahead of it.
  struct View {
    Eigen::Vector2f direction;  ///< unit: where it wants to go
    float free_speed = 0;       ///< m/s
    float reach_sq = 0;         ///< m^2: others count up to there
    float file_share = 1;       ///< of the free speed, at most, in single file
  };
  View view(const Crowd& crowd, const Grid& grid, const AgentView& around) const;

  /// People per m^2 in the half disc ahead. Those straight ahead and near count most: by
  /// (1 - d^2/R^2) cos(angle) for the distance d, where R is the reach, or the distance of the
  /// farthest whom the agent minds if it minds as many as it can.
  struct Ahead {
    float along = 0;    ///< without those who come towards one, 1/m^2
    float against = 0;  ///< those who do, 1/m^2
  };

  SpeedRegulation regulation(const View& view, const Ahead& ahead) const;

 private:
  PaceSpec spec_;
};

/// Ahead for several agents at once, one per lane.
class PaceBatch {
 public:
  void set(std::size_t lane, const Pace::View& view) { views_[lane] = view; }
  const Pace::View& view(std::size_t lane) const { return views_[lane]; }
  /// Once a kernel has run.
  Pace::Ahead ahead(std::size_t lane) const { return {along_[lane], against_[lane]}; }

  /// `directions`: preferred directions by the grid's slots. `agents`: neighbors of those of the
  /// batch see, filled. An agent's figures do not depend on who else is in the batch.
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
