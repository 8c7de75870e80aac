// Ground and doors that growing disasters block: a sequence of discs in the crowd's files.
#pragma once

#include <cstdint>
#include <vector>

#include "spec/blueprint/people.h"
#include "world/scenario.h"

namespace throng::scenarios {

/// Obstacle class of the discs that exist before anybody flees.
inline constexpr std::uint32_t kFirstClass = 2;

/// A disc around a disaster that fleeing people do not enter from a time on.
struct BlockedDisc {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();  ///< m
  double radius_m = 0;
  double from_s = 0;
  std::uint32_t obstacle_class = kFirstClass;  ///< bit of the class in the Menge scene
};

/// The discs of all disasters, those of each disaster in order of time. The first has the radius
/// Danger::blocked_m; later ones grow with the disaster for 5 minutes, in steps of about 2 m or
/// more, at most 6 per disaster and 24 in all.
std::vector<BlockedDisc> blocked_discs(const People& people);

/// The earliest disc that reaches a door, from whose time on the door is closed for fleeing people;
/// null if there is none.
const BlockedDisc* first_to_reach(const world::Exit& exit, const std::vector<BlockedDisc>& discs);

/// Whether anybody can ever flee through a door if `first` is the first disc that reaches it (null:
/// none does).
bool can_flee_by(const BlockedDisc* first);

}  // namespace throng::scenarios
