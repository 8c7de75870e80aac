// Builds descriptions in code.
//
//   SceneBuilder scene;
//   scene.add_profile({.name = "adult", .common = {{"r", 0.2}}});
//   scene.add_group({.profile = "adult", .state = "Walk", .generator = agents_at({{0, 0}})});
//   BehaviorBuilder behavior;
//   behavior.add_goal_set(0, {circle_goal(0, {8, 0}, 1)});
//   behavior.add_state("Walk", {select_goal("nearest", 0), velocity("auto")});
//   behavior.add_final_state("Out", {action("leave")});
//   behavior.add_transition("Walk", "Out", goal_reached());
//   Simulation crowd(scene.build(), behavior.build(), {.seed = 7});
//
// Nothing is checked before a simulation is made.
#pragma once

#include <string>
#include <vector>

#include "crowd/description/description.h"
#include "crowd/description/elements.h"

namespace throng::crowd {

/// Properties that agents have in common (docs/crowd.md lists attributes and properties).
struct AgentProfile {
  std::string name;
  std::string inherits = {};           ///< the name of an earlier profile, or empty
  std::vector<Attribute> common = {};  ///< the same for all: {"r", 0.2}, {"max_speed", 2}
  std::vector<Node> properties = {};   ///< sampled for each agent: describe::property(...)
  std::vector<Node> models = {};       ///< parameters of pedestrian models: describe::model(...)
};

/// Agents of one profile that begin in one state.
struct AgentGroup {
  std::string profile;
  std::string state;
  Node generator;               ///< describe::agents_at(...), or another <Generator>
  std::vector<Node> more = {};  ///< <Facing>, <Arrivals>
};

class SceneBuilder {
 public:
  explicit SceneBuilder(double time_step_s = 0.1);

  SceneBuilder& add_profile(AgentProfile profile);
  SceneBuilder& add_group(AgentGroup group);
  /// Obstacles of one class: agents mind those whose class is in their profile's "obstacleSet".
  SceneBuilder& add_obstacles(const std::vector<describe::Points>& outlines, int obstacle_class = 1,
                              int decimals = describe::kAllDigits);
  /// Any other element of a scene: a model's constants, <Elevation>, <SocialGroups>, ...
  SceneBuilder& add(Node element);
  /// A comment of the file before what is added next.
  SceneBuilder& comment(std::string text);

  const SceneDescription& build() const { return description_; }

 private:
  SceneDescription description_;
  std::string comment_;
};

class BehaviorBuilder {
 public:
  BehaviorBuilder& add_goal_set(int id, std::vector<Node> goals);
  /// `parts`: a goal selector, a velocity component, actions, velocity modifiers.
  BehaviorBuilder& add_state(std::string name, std::vector<Node> parts = {});
  /// One in which agents are done: a simulation in which all are is over.
  BehaviorBuilder& add_final_state(std::string name, std::vector<Node> parts = {});
  /// From a state, or several separated by commas, when the condition holds.
  BehaviorBuilder& add_transition(std::string from, std::string to, Node condition);
  /// Any other element of a behavior: <Panic>, <EventSystem>, <Task>, <VelModifier>, ...
  BehaviorBuilder& add(Node element);
  /// A comment of the file before what is added next.
  BehaviorBuilder& comment(std::string text);

  const BehaviorDescription& build() const { return description_; }

 private:
  BehaviorDescription description_;
  std::string comment_;
};

}  // namespace throng::crowd
