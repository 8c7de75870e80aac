// What disasters take of the ground as they grow: rings that the crowd's files say, one after
// another.
#pragma once

#include <cstdint>
#include <vector>

#include "places/people.h"

namespace throng::places {

/// A disc about a disaster that nobody enters who flees, from a time on.
struct BlockedDisc {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();  ///< m
  double radius_m = 0;
  double from_s = 0;
  std::uint32_t obstacle_class = 2;  ///< of the Menge scene; all that are there at first have 2
};

/// The discs of all disasters: at first `blocked_m` of each; later ones as much larger as the
/// disaster has grown, in steps of 2 m or more, at most 6 of each and 24 in all, for 5 minutes.
std::vector<BlockedDisc> blocked_discs(const People& people);

}  // namespace throng::places
