// How fast people walk where it is crowded ahead of them.
#pragma once

#include "crowd/neighborhood.h"

namespace throng::crowd {

/// Parameters of Pace. The values are those that bench/calibrate_crowd finds (docs/crowd.md).
struct PaceSpec {
  float reach_m = 1.7F;       ///< how far ahead others count
  float jam_density = 4.82F;  ///< 1/m^2
  float decline = 1.56F;      ///< 1/m^2
  float least = 0.145F;       ///< share of the free speed that is left in a jam
};

/// Limits the preferred speed by the density ahead as Weidmann's fundamental diagram has it (1993,
/// Schriftenreihe des IVT 90): v0 (1 - exp(-decline (1/density - 1/jam_density))), but never below
/// least v0, so that no crowd locks. v0 is the agent's free speed.
class Pace {
 public:
  explicit Pace(const PaceSpec& spec) : spec_(spec) {}

  /// Of the free speed, at most 1.
  float share(const Crowd& crowd, const Grid& grid, const Surroundings& around) const;

  /// People per m^2 in the half disc ahead. Those straight ahead and near count most: by
  /// (1 - d^2/R^2) cos(angle) for the distance d, where R is the reach, or the distance of the
  /// farthest whom the agent minds if it minds as many as it can.
  float density_ahead(const Crowd& crowd, const Grid& grid, const Surroundings& around) const;

 private:
  PaceSpec spec_;
};

}  // namespace throng::crowd
