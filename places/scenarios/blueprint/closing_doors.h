// Exits of a blueprint that are closed or close: the obstacles in them and the crowd's elements.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "base/error.h"
#include "crowd/description/builder.h"
#include "places/scenarios/blueprint/blocked.h"

namespace throng::scenarios {

/// An exit that nobody passes from a time on.
struct ClosingDoor {
  world::Exit exit;
  double from_s = 0;  ///< 0: closed from the start
  /// Bit of the class of its obstacle: that of walls if it is closed from the start, else its own.
  std::uint32_t obstacle_class = 1;
};

/// Whether people who know the exits may choose this one: it is not closed from the start, or all
/// are.
bool is_destination(const world::Exit& exit, const std::vector<world::Exit>& exits);

/// When an exit closes, by itself or by the first disc that reaches it (s); infinite: never.
double closing_time_s(const world::Exit& exit, const std::vector<BlockedDisc>& discs);

/// The exits that are closed or close. Adds a problem for those beyond the number of classes of
/// obstacles; doors beyond it that disasters close stay open for people without notice.
std::vector<ClosingDoor> closing_doors(const std::vector<world::Exit>& exits,
                                       const std::vector<BlockedDisc>& discs,
                                       std::vector<Problem>& problems);

/// The outline that closes a door: from its line to beyond the goal of those who take it.
std::vector<Eigen::Vector2d> shutter(const world::Exit& exit);

/// The door in the crowd's behavior.
crowd::Node closing_element(const ClosingDoor& door);

}  // namespace throng::scenarios
