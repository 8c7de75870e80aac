// People one after the other, where walls leave no room to walk abreast.
#pragma once

#include "crowd/spatial/neighborhood.h"

namespace throng::crowd {

/// Radii that two need who pass each other: farther walls do not matter to singleness().
inline constexpr float kPassingRadii = 5.5F;

/// 1 where walls at both sides leave room for one only, 0 where two can pass each other, and
/// between these in between.
float singleness(const Crowd& crowd, const Grid& grid, const AgentView& around);

/// How far straight on until one touches somebody who does not come towards one, m; infinite
/// without anybody ahead. Others who are farther aside than half of the distance at which both
/// touch do not count.
float gap_ahead_m(const Crowd& crowd, const Grid& grid, const AgentView& around);

}  // namespace throng::crowd
