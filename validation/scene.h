// Scenes for validating the crowd engine, built in code with the public builders.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "crowd/description/builder.h"
#include "crowd/description/options.h"
#include "crowd/simulation.h"

namespace throng::validation {

namespace describe = crowd::describe;
using describe::Sampled;

/// Corners of an obstacle in order, counter-clockwise, m.
using Polygon = std::vector<Eigen::Vector2d>;

/// Returns an axis-parallel box.
Polygon box(double min_x, double min_y, double max_x, double max_y);

/// People with the same properties.
struct Group {
  std::vector<Eigen::Vector2d> places;
  /// Free speed, m/s; by default that of Weidmann (1993).
  Sampled speed = Sampled::normal(1.34, 0.26).limited(0.58, 2.1);
  double radius_m = crowd::kAdultRadiusM;
  double aside_m = 0.02;  ///< max random offset of the start position per axis
  std::string state = "Walk";
  std::vector<crowd::Node> more = {};  ///< further elements, e.g. <Arrivals>
};

/// A BehaviorBuilder with the parts that most tests need.
class Behavior : public crowd::BehaviorBuilder {
 public:
  /// Adds a goal set with one box.
  Behavior& goal_box(int goal_set, double min_x, double min_y, double max_x, double max_y);
  /// Adds a state in which people walk around all walls to the nearest goal of a set.
  Behavior& walk_to(int goal_set, const std::string& state = "Walk");
  /// Adds the final state "Gone", which people enter when they reach their goal in one of the
  /// states.
  Behavior& leave_at_goal(const std::string& states = "Walk");
};

/// Walls, people and behavior of a test.
struct TestScene {
  std::vector<Polygon> walls;
  std::vector<Polygon> later_walls;  ///< walls that appear when an action adds obstacle class 2
  std::vector<Group> groups;
  Behavior behavior;
  std::map<std::string, std::string> files;  ///< files that the behavior names
  double dt_s = 0.1;
};

/// A pedestrian model with its parameters.
struct Tested {
  std::string model;
  std::vector<crowd::Node> constants = {};  ///< element with constants for the scene; may be empty
  std::vector<crowd::Node> profile = {};  ///< element with parameters for the profile; may be empty
  crowd::ConstantsChoice choice = crowd::ConstantsChoice::best;
};

/// Returns the model's name, with the choice of its constants if that is not the best fit.
std::string title(const Tested& tested);

/// Returns `count` points of a lattice of nearly square cells that fills a box.
std::vector<Eigen::Vector2d> lattice(const Eigen::Vector2d& low, const Eigen::Vector2d& high,
                                     std::size_t count);

/// Creates the simulation of a scene. Force-based models compute five sub-steps per step.
crowd::Simulation load(const TestScene& scene, const Tested& tested, std::uint64_t seed);

}  // namespace throng::validation
