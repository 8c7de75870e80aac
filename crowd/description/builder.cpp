#include "crowd/description/builder.h"

#include <utility>

namespace throng::crowd {

using describe::typed;

SceneBuilder::SceneBuilder(double time_step_s) {
  add(typed("SpatialQuery", "kd-tree", {{"test_visibility", false}}));
  add(Node("Common", {{"time_step", time_step_s}}));
}

SceneBuilder& SceneBuilder::add_profile(AgentProfile profile) {
  Node node("AgentProfile", {{"name", std::move(profile.name)}});
  if (!profile.inherits.empty()) node.set({"inherits", std::move(profile.inherits)});
  node.add(Node("Common", std::move(profile.common), std::move(profile.properties)));
  for (Node& model : profile.models) node.add(std::move(model));
  return add(std::move(node));
}

SceneBuilder& SceneBuilder::add_group(AgentGroup group) {
  Node node("AgentGroup");
  node.add(typed("ProfileSelector", "const", {{"name", std::move(group.profile)}}));
  node.add(typed("StateSelector", "const", {{"name", std::move(group.state)}}));
  node.add(std::move(group.generator));
  for (Node& element : group.more) node.add(std::move(element));
  return add(std::move(node));
}

SceneBuilder& SceneBuilder::add_obstacles(const std::vector<describe::Points>& outlines,
                                          int obstacle_class, int decimals) {
  Node set = typed("ObstacleSet", "explicit", {{"class", obstacle_class}});
  for (const describe::Points& outline : outlines) set.add(describe::obstacle(outline, decimals));
  return add(std::move(set));
}

SceneBuilder& SceneBuilder::add(Node element) {
  if (!comment_.empty()) element.comment = std::exchange(comment_, {});
  description_.root.add(std::move(element));
  return *this;
}

SceneBuilder& SceneBuilder::comment(std::string text) {
  comment_ = std::move(text);
  return *this;
}

BehaviorBuilder& BehaviorBuilder::add_goal_set(int id, std::vector<Node> goals) {
  return add(Node("GoalSet", {{"id", id}}, std::move(goals)));
}

BehaviorBuilder& BehaviorBuilder::add_state(std::string name, std::vector<Node> parts) {
  return add(Node("State", {{"name", std::move(name)}, {"final", false}}, std::move(parts)));
}

BehaviorBuilder& BehaviorBuilder::add_final_state(std::string name, std::vector<Node> parts) {
  return add(Node("State", {{"name", std::move(name)}, {"final", true}}, std::move(parts)));
}

BehaviorBuilder& BehaviorBuilder::add_transition(std::string from, std::string to, Node condition) {
  Node node("Transition", {{"from", std::move(from)}, {"to", std::move(to)}});
  return add(std::move(node.add(std::move(condition))));
}

BehaviorBuilder& BehaviorBuilder::add(Node element) {
  if (!comment_.empty()) element.comment = std::exchange(comment_, {});
  description_.root.add(std::move(element));
  return *this;
}

BehaviorBuilder& BehaviorBuilder::comment(std::string text) {
  comment_ = std::move(text);
  return *this;
}

}  // namespace throng::crowd
