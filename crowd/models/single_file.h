// Detection of single file, where walls leave no room to walk side by side.
#pragma once

#include <span>

#include "crowd/state/neighborhood.h"

namespace throng::crowd {

/// Widths between which a passage has room for one person and for two who pass each other, m.
struct PassingRoom {
  float one_m = 0.9F;
  float two_m = 1.1F;
};

/// Room for people of other sizes than adults: 4.5 and 5.5 radii.
inline constexpr float kOneRadii = 4.5F;
inline constexpr float kPassingRadii = 5.5F;

/// Returns 1 if the walls on both sides leave room for one person, 0 if two can pass each other,
/// and intermediate values between. Walls farther away than `room.two_m` do not matter.
float singleness(const Crowd& crowd, const Grid& grid, const AgentView& around,
                 const PassingRoom& room);

/// Returns the distance (m) straight ahead until the agent touches a person who is not oncoming;
/// infinity if there is none. People whose lateral distance is more than half of the distance at
/// which both touch do not count, and, if `file` is given, those for whom it is at most 0.5 (by
/// agent: singleness(), so that people who have left a narrow part hold up nobody in it). The gap
/// is that of `foresight_s` later if both keep their velocities.
float gap_ahead_m(const Crowd& crowd, const Grid& grid, const AgentView& around,
                  std::span<const float> file = {}, float foresight_s = 0);

}  // namespace throng::crowd
