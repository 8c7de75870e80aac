// Scenes for validating the crowd engine, built in code as users' programs build theirs.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "crowd/description/builder.h"
#include "crowd/simulation.h"

namespace throng::validation {

namespace describe = crowd::describe;
using describe::Sampled;

/// Corners of an obstacle in order, counter-clockwise, m.
using Polygon = std::vector<Eigen::Vector2d>;

/// A box along the axes.
Polygon box(double min_x, double min_y, double max_x, double max_y);

/// People of one kind.
struct Group {
  std::vector<Eigen::Vector2d> places;
  /// Free speed, m/s. Weidmann's (1993) by default.
  Sampled speed = Sampled::normal(1.34, 0.26).limited(0.58, 2.1);
  double radius_m = 0.2;
  double aside_m = 0.02;  ///< at most so far from their place they begin, at random
  std::string state = "Walk";
  std::vector<crowd::Node> more = {};  ///< further elements of the group, e.g. <Arrivals>
};

/// A behavior, and what most tests put into one.
class Behavior : public crowd::BehaviorBuilder {
 public:
  /// A goal set of one box.
  Behavior& goal_box(int goal_set, double min_x, double min_y, double max_x, double max_y);
  /// A state in which people go around all walls to the goals of a set, the nearest one.
  Behavior& walk_to(int goal_set, const std::string& state = "Walk");
  /// The final state "Gone", which people take who reach their goal in one of the states.
  Behavior& leave_at_goal(const std::string& states = "Walk");
};

struct Scene {
  std::vector<Polygon> walls;
  std::vector<Polygon> later_walls;  ///< in nobody's way until an action adds obstacle class 2
  std::vector<Group> groups;
  Behavior behavior;
  std::map<std::string, std::string> files;  ///< that the behavior names
  double dt_s = 0.1;
};

/// A pedestrian model, with parameters other than its own if need be.
struct Tested {
  std::string model;
  std::vector<crowd::Node> constants = {};  ///< its element of a scene, or nothing
  std::vector<crowd::Node> profile = {};    ///< its element of a profile, or nothing
};

/// So many places on a lattice of nearly squares that fills a box.
std::vector<Eigen::Vector2d> lattice(const Eigen::Vector2d& low, const Eigen::Vector2d& high,
                                     std::size_t count);

/// The scene as it begins. Models of forces compute five steps in one, as they need to.
crowd::Simulation load(const Scene& scene, const Tested& tested, std::uint64_t seed);

}  // namespace throng::validation
