// Builders that create the description of a scene and of a behavior in code.
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
// The builders check nothing; errors are reported when a Simulation is created.
#pragma once

#include <string>
#include <vector>

#include "crowd/description/description.h"
#include "crowd/description/elements.h"

namespace throng::crowd {

/// Properties shared by agents (docs/crowd.md lists attributes and properties).
struct AgentProfile {
  std::string name;
  std::string inherits = {};           ///< name of an earlier profile; may be empty
  std::vector<Attribute> common = {};  ///< equal for all agents: {"r", 0.2}, {"max_speed", 2}
  std::vector<Node> properties = {};   ///< sampled per agent: describe::property(...)
  std::vector<Node> models = {};       ///< parameters of pedestrian models: describe::model(...)
};

/// Agents with the same profile and initial state.
struct AgentGroup {
  std::string profile;
  std::string state;
  Node generator;               ///< describe::agents_at(...) or another <Generator>
  std::vector<Node> more = {};  ///< further elements: <Facing>, <Arrivals>
};

/// Builds a SceneDescription. Elements keep the order of the calls; functions return *this.
class SceneBuilder {
 public:
  explicit SceneBuilder(double time_step_s = 0.1);

  SceneBuilder& add_profile(AgentProfile profile);
  SceneBuilder& add_group(AgentGroup group);
  /// Adds obstacles of one class. Agents avoid the classes in the attribute "obstacleSet" of their
  /// profile. `decimals`: decimals of coordinates in the file, or kAllDigits.
  SceneBuilder& add_obstacles(const std::vector<describe::Points>& outlines, int obstacle_class = 1,
                              int decimals = describe::kAllDigits);
  /// Adds another element: constants of a model, <Elevation>, <SocialGroups>, ...
  SceneBuilder& add(Node element);
  /// Writes an XML comment before the next element.
  SceneBuilder& comment(std::string text);

  const SceneDescription& build() const { return description_; }

 private:
  SceneDescription description_;
  std::string comment_;
};

/// Builds a BehaviorDescription. Elements keep the order of the calls; functions return *this.
class BehaviorBuilder {
 public:
  BehaviorBuilder& add_goal_set(int id, std::vector<Node> goals);
  /// `parts`: a goal selector, a velocity component, actions, velocity modifiers.
  BehaviorBuilder& add_state(std::string name, std::vector<Node> parts = {});
  /// Adds a state in which agents have finished; a run ends when all agents are in final states.
  BehaviorBuilder& add_final_state(std::string name, std::vector<Node> parts = {});
  /// Adds a transition. `from`: a state, or several separated by commas.
  BehaviorBuilder& add_transition(std::string from, std::string to, Node condition);
  /// Adds another element: <Panic>, <EventSystem>, <Task>, <VelModifier>, ...
  BehaviorBuilder& add(Node element);
  /// Writes an XML comment before the next element.
  BehaviorBuilder& comment(std::string text);

  const BehaviorDescription& build() const { return description_; }

 private:
  BehaviorDescription description_;
  std::string comment_;
};

}  // namespace throng::crowd
