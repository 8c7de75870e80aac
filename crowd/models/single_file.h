// Detection of single file, where walls leave no room to walk side by side.
#pragma once

#include "crowd/spatial/neighborhood.h"

namespace throng::crowd {

/// Room that two people need to pass each other, in radii; farther walls do not matter to
/// singleness().
inline constexpr float kPassingRadii = 5.5F;

/// Returns 1 if the walls on both sides leave room for one person, 0 if two can pass each other,
/// and intermediate values between.
float singleness(const Crowd& crowd, const Grid& grid, const AgentView& around);

/// Returns the distance (m) straight ahead until the agent touches a person who is not oncoming;
/// infinity if there is none. People whose lateral distance is more than half of the distance at
/// which both touch do not count.
float gap_ahead_m(const Crowd& crowd, const Grid& grid, const AgentView& around);

}  // namespace throng::crowd
