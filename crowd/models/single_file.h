// Detection of single file, where walls leave no room to walk side by side.
#pragma once

#include <span>

#include "crowd/state/neighborhood.h"

namespace throng::crowd {

/// Widths between which a passage has room for one person and for two who pass each other, m.
struct PassingRoom {
  float one_m = 0.9F;
  float two_m = 1.1F;

  /// Returns 1 if there is room for one person only, 0 if two can pass each other, and intermediate
  /// values between.
  float singleness(float width_m) const;
};

/// Room for people of other sizes than adults: 4.5 and 5.5 radii.
inline constexpr float kOneRadii = 4.5F;
inline constexpr float kPassingRadii = 5.5F;

/// Returns the distance between the walls on both sides of an agent (m); each of them counts as
/// `reach_m` away where it is farther, or is not there.
float passage_width_m(const Crowd& crowd, const Grid& grid, const AgentView& around, float reach_m);

/// Returns how far ahead the walls continue (m): the mean of the left and the right. Walls farther
/// aside than `reach_m` do not count.
float passage_ahead_m(const Crowd& crowd, const Grid& grid, const AgentView& around, float reach_m);

/// Returns the distance (m) straight ahead until the agent touches a person who is not oncoming;
/// infinity if there is none. People whose lateral distance is more than half of the distance at
/// which both touch do not count. The gap is that of `foresight_s` later if both keep their
/// velocities.
float gap_ahead_m(const Crowd& crowd, const Grid& grid, const AgentView& around,
                  float foresight_s = 0);

}  // namespace throng::crowd
