#include "crowd/state/goals.h"

#include <fmt/core.h>

#include <algorithm>

namespace throng::crowd {

int Goals::load_set(const Element& element) {
  const Attributes attributes(element, {integer("id", "of the set", 0, kMaxId)});
  const auto id = static_cast<int>(attributes.integer("id"));
  int set = find_set(id);
  if (set >= 0) {
    element.warn_attribute("id", fmt::format("{} again; its goals join those of the first", id),
                           "an id not used before");
  } else {
    set = static_cast<int>(sets_.size());
    sets_.push_back({id, {}});
    used_.push_back(0);
  }
  for (const Element& child : element.children()) {
    if (child.name() != "Goal") child.fail_unknown("<Goal>");
    sets_[static_cast<std::size_t>(set)].goals.push_back(add_goal(child, set));
  }
  return set;
}

int Goals::add_goal(const Element& element, int set) {
  const GoalRegistry::Entry& entry = goal_registry().find(element);
  if (entry.type != "path") element.require_no_children();
  const Attributes attributes(element, entry.attributes);
  Goal goal;
  goal.id = {this->set(set).id, static_cast<std::int32_t>(attributes.integer("id"))};
  if (find_goal(goal.id.set, goal.id.goal) >= 0) {
    element.fail_attribute("id", fmt::format("{} again", goal.id.goal),
                           "an id not used before in this set");
  }
  goal.capacity = static_cast<std::uint32_t>(attributes.integer("capacity"));
  goal.weight = attributes.real("weight");
  GoalContext context;
  goal.shape = entry.make(element, attributes, context);
  if (context.path) {
    goal.on_path = goal.shape->center();
    goal.path = std::move(context.path);
    goal.shape->move_to(goal.path->position() + goal.on_path);
  }
  goals_.push_back(std::move(goal));
  return static_cast<int>(goals_.size()) - 1;
}

void Goals::advance_paths(double dt_s) {
  for (Goal& goal : goals_) {
    if (!goal.path) continue;
    goal.path->advance(dt_s);
    goal.shape->move_to(goal.path->position() + goal.on_path);
  }
}

bool Goals::any_path() const {
  return std::any_of(goals_.begin(), goals_.end(),
                     [](const Goal& goal) { return goal.path != nullptr; });
}

int Goals::find_set(int set_id) const {
  for (std::size_t i = 0; i < sets_.size(); ++i) {
    if (sets_[i].id == set_id) return static_cast<int>(i);
  }
  return -1;
}

int Goals::find_goal(int set_id, int goal_id) const {
  const int index = find_set(set_id);
  if (index < 0) return -1;
  for (const int goal : set(index).goals) {
    if ((*this)[goal].id.goal == goal_id) return goal;
  }
  return -1;
}

int Goals::require_set(const Element& element, const Attributes& attributes,
                       std::string_view attribute) const {
  const auto id = static_cast<int>(attributes.integer(attribute));
  const int index = find_set(id);
  if (index >= 0) {
    if (set(index).goals.empty()) {
      element.fail_attribute(attribute, fmt::format("{}, which is an empty goal set", id),
                             "a goal set with at least one <Goal>");
    }
    used_[static_cast<std::size_t>(index)] = 1;
    return index;
  }
  std::string known;
  for (const GoalSet& each : sets_) known += fmt::format(" {}", each.id);
  element.fail_attribute(
      attribute, fmt::format("{}, which is no goal set", id),
      known.empty() ? "a goal set (there is none)" : fmt::format("the id of a goal set:{}", known));
}

}  // namespace throng::crowd
