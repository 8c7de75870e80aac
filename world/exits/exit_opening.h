// The openings that buildings leave at the exits of a scenario.
#pragma once

#include <vector>

#include "world/scenario.h"

namespace throng::world {

/// Cuts off the ends of exits that lie in buildings, and sets Exit::free_m and Exit::drawn_m. The
/// width is that of the narrowest parallel of the exit's line within 0.5 m, since a line may be
/// drawn on either face of a wall; lanes below 0.3 m, which nobody passes, count as closed. An exit
/// that is all in a building stays as it is: the wall in which a door is drawn.
void trim_to_openings(const std::vector<Building>& buildings, std::vector<Exit>& exits);

}  // namespace throng::world
