// Ground and doors that disasters block as they grow: discs that the crowd's files define,
// one after another.
#pragma once

#include <cstdint>
#include <vector>

#include "world/scenario.h"
#include "world/scenarios/blueprint/people.h"

namespace throng::scenarios {

/// Obstacles of this class are there before anybody flees.
inline constexpr std::uint32_t kFirstClass = 2;

/// A disc about a disaster that nobody enters who flees, from a time on.
struct BlockedDisc {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();  ///< m
  double radius_m = 0;
  double from_s = 0;
  std::uint32_t obstacle_class = kFirstClass;  ///< of the Menge scene
};

/// The discs of all disasters, each disaster's by time: at its start `blocked_m`; later ones as
/// much larger as the disaster has grown, in steps of 2 m or more, at most 6 of each and 24 in all,
/// for 5 minutes.
std::vector<BlockedDisc> blocked_discs(const People& people);

/// The earliest of the discs that reach a door; null if none does. From its time on the door is
/// closed for all who flee.
const BlockedDisc* first_to_reach(const world::Exit& exit, const std::vector<BlockedDisc>& discs);

/// Whether anybody can ever flee by a door that this disc (null: none) is the first to reach.
bool can_flee_by(const BlockedDisc* first);

}  // namespace throng::scenarios
