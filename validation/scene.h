// Scenes for validating the crowd engine, built in code and given to it as the files it reads, so
// that what is validated is what users run.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "crowd/simulation.h"

namespace throng::validation {

/// Corners of an obstacle in order, counter-clockwise, m.
using Polygon = std::vector<Eigen::Vector2d>;

/// A box along the axes.
Polygon box(double min_x, double min_y, double max_x, double max_y);

/// People of one kind.
struct Group {
  std::vector<Eigen::Vector2d> places;
  /// Free speed: a distribution as the files write it, m/s. Weidmann's (1993) by default.
  std::string speed = R"(dist="n" mean="1.34" stddev="0.26" at_least="0.58" at_most="2.1")";
  double radius_m = 0.2;
  double aside_m = 0.02;  ///< at most so far from their place they begin, at random
  std::string state = "Walk";
  std::string more =
      {};  ///< further elements of the group as the files write them, e.g. <Arrivals>
};

struct Scene {
  std::vector<Polygon> walls;
  std::vector<Polygon> later_walls;  ///< in nobody's way until an action adds obstacle class 2
  std::vector<Group> groups;
  std::string behavior;                                    ///< what is in <BFSM>
  std::vector<std::pair<std::string, std::string>> files;  ///< names and texts, beside these
  double dt_s = 0.1;
};

/// A pedestrian model, with parameters other than its own if need be.
struct Tested {
  std::string model;
  std::string constants = {};  ///< its element of a scene, or nothing
  std::string profile = {};    ///< its element of a profile, or nothing
};

/// So many places on a lattice of nearly squares that fills a box.
std::vector<Eigen::Vector2d> lattice(const Eigen::Vector2d& low, const Eigen::Vector2d& high,
                                     std::size_t count);

/// A state in which people go around all walls to the goals of a set, the nearest one.
std::string walk_to(int goal_set, const std::string& state = "Walk");
/// A goal set of one box.
std::string goal_box(int goal_set, double min_x, double min_y, double max_x, double max_y);
/// The final state "Gone", which people take who reach their goal in `state`.
std::string leave_at_goal(const std::string& state = "Walk");

/// The scene as it begins. Models of forces compute five steps in one, as they need to.
crowd::Simulation load(const Scene& scene, const Tested& tested, std::uint64_t seed);

}  // namespace throng::validation
