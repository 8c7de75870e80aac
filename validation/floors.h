// Floor plans and walks shared by several tests.
#pragma once

#include "validation/suite.h"

namespace throng::validation {

enum class Side { left, right, bottom, top };

/// A door in a wall of a room; its position along the wall counts from the corner (0, 0).
struct Door {
  Side side = Side::right;
  double at_m = 0;
  double width_m = 1;
};

/// Returns the walls, 0.2 m thick, of a room from (0, 0) to (width, height) in m.
std::vector<Polygon> room(double width, double height, const std::vector<Door>& doors);

/// Creates a goal of 1 m x 1 m behind a door.
crowd::Node exit_goal(int id, double x, double y);

struct Corridor {
  double time_s = 0;   ///< for 40 m
  bool inside = true;  ///< whether the person stays inside
};

/// Simulates one person with this free speed in a corridor of 2 m x 40 m.
Corridor walk_corridor(const Tested& tested, double speed_mps);

/// Returns the mean speed (m/s) of each of `people` who walk far from each other; `speed` is the
/// distribution of their free speeds.
std::vector<double> walk_alone(const Tested& tested, const Sampled& speed, std::size_t people);

/// Returns the number of people who leave near each of these exits within `max_s`.
std::vector<int> exits_used(crowd::Simulation& crowd, const std::vector<Eigen::Vector2d>& exits,
                            double max_s);

/// RiMEA 6 and NIST 2.3: 20 people walk around a corner within `max_s`.
Verdict round_corner(const Tested& tested, double max_s);
/// RiMEA 10 and NIST 3.1: assignment of people to exits.
Verdict assigned_exits(const Tested& tested, Effort effort);
/// RiMEA 16: speed in single file.
Verdict single_file(const Tested& tested, Effort effort);

}  // namespace throng::validation
