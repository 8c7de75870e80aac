// Floor plans and walks that several tests use.
#pragma once

#include "crowd/validation/suite.h"

namespace throng::validation {

enum class Side { left, right, bottom, top };

/// A door in a wall of a room, at this distance from the room's corner (0, 0) along the wall.
struct Door {
  Side side = Side::right;
  double at_m = 0;
  double width_m = 1;
};

/// The walls, 0.2 m thick, around a room from (0, 0) to (width, height).
std::vector<Polygon> room(double width, double height, const std::vector<Door>& doors);

/// A goal behind a door: a box of 1 m x 1 m.
crowd::Node exit_goal(int id, double x, double y);

struct Corridor {
  double time_s = 0;   ///< for 40 m
  bool inside = true;  ///< all the way
};

/// One person with this free speed through a corridor of 2 m x 40 m.
Corridor walk_corridor(const Tested& tested, double speed_mps);

/// The mean speeds of so many people on a plain, far from each other, in m/s. `speed` is their free
/// speed.
std::vector<double> walk_alone(const Tested& tested, const Sampled& speed, std::size_t people);

/// How many left next to each of these places within `max_s`.
std::vector<int> exits_used(crowd::Simulation& crowd, const std::vector<Eigen::Vector2d>& exits,
                            double max_s);

/// RiMEA 6 and NIST 2.3: 20 people round a corner, within `max_s`.
Verdict round_corner(const Tested& tested, double max_s);
/// RiMEA 10 and NIST 3.1.
Verdict assigned_exits(const Tested& tested, Effort effort);
/// RiMEA 16.
Verdict single_file(const Tested& tested, Effort effort);

}  // namespace throng::validation
