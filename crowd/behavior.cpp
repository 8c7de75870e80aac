#include "crowd/behavior.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>

namespace throng::crowd {

namespace {

AttributeTable state_attributes() {
  return {text("name", "a name that no other state has"),
          boolean("final", "1: the run may end when everyone is in such states")};
}

/// Always the same state: the `to` of a transition.
class Fixed : public Target {
 public:
  explicit Fixed(std::uint8_t state) : state_(state) {}
  std::uint8_t state(const Crowd&, std::size_t) override { return state_; }

 private:
  std::uint8_t state_;
};

/// The state's only child of a kind.
template <typename Product>
void make_only(const Registry<Product, BehaviorContext>& registry, const Element& element,
               BehaviorContext& context, std::unique_ptr<Product>& place) {
  if (place) {
    element.fail(fmt::format("a second <{}>", element.name()),
                 fmt::format("at most one <{}>", element.name()));
  }
  element.require_no_children();
  place = registry.make(element, context);
}

template <typename Product>
void make_another(const Registry<Product, BehaviorContext>& registry, const Element& element,
                  BehaviorContext& context, std::vector<std::unique_ptr<Product>>& list) {
  element.require_no_children();
  list.push_back(registry.make(element, context));
}

MachineState load_state(const Element& element, BehaviorContext& context) {
  const Attributes attributes(element, state_attributes());
  MachineState state;
  state.final = attributes.boolean("final");
  for (const Element& child : element.children()) {
    if (child.name() == "GoalSelector") {
      make_only(goal_selector_registry(), child, context, state.goal_selector);
    } else if (child.name() == "VelComponent") {
      make_only(vel_component_registry(), child, context, state.velocity);
    } else if (child.name() == "Action") {
      make_another(action_registry(), child, context, state.actions);
    } else if (child.name() == "VelModifier") {
      make_another(vel_modifier_registry(), child, context, state.modifiers);
    } else {
      child.fail_unknown("<GoalSelector>, <VelComponent>, <Action> or <VelModifier>");
    }
  }
  return state;
}

/// The names between the commas, without the spaces around them.
std::vector<std::string> split_names(const std::string& list) {
  std::vector<std::string> names;
  for (std::size_t begin = 0; begin <= list.size();) {
    const std::size_t end = std::min(list.find(',', begin), list.size());
    std::string name = list.substr(begin, end - begin);
    name.erase(0, std::min(name.find_first_not_of(' '), name.size()));
    name.erase(name.find_last_not_of(' ') + 1);
    names.push_back(std::move(name));
    begin = end + 1;
  }
  return names;
}

Transition load_transition(const Element& element, const Attributes& attributes,
                           BehaviorContext& context) {
  Transition transition;
  for (const Element& child : element.children()) {
    if (child.name() == "Condition") {
      if (transition.condition) child.fail("a second <Condition>", "exactly one <Condition>");
      transition.condition = condition_registry().make(child, context);
    } else if (child.name() == "Target") {
      if (transition.target) child.fail("a second <Target>", "at most one <Target>");
      transition.target = target_registry().make(child, context);
    } else {
      child.fail_unknown("<Condition> or <Target>");
    }
  }
  if (!transition.condition) element.fail("no <Condition>", "exactly one <Condition>");
  if (attributes.has("to")) {
    const std::uint8_t to = context.require_state(element, "to", attributes.text("to"));
    if (!transition.target) transition.target = std::make_unique<Fixed>(to);
  }
  if (!transition.target) element.fail("neither `to` nor <Target>", "one of them");
  return transition;
}

/// A transition from several states is as many transitions, so that none shares what it draws.
void load_transitions(const Element& element, BehaviorContext& context, Behavior& behavior) {
  const Attributes attributes(element, {text("from", "names of states, separated by commas"),
                                        optional(text("to", "the name of a state"))});
  for (const std::string& name : split_names(attributes.text("from"))) {
    const std::uint8_t from = context.require_state(element, "from", name);
    behavior.states[from].transitions.push_back(load_transition(element, attributes, context));
  }
}

}  // namespace

Draws BehaviorContext::make_draws(std::optional<std::uint64_t> fixed_seed) {
  const std::uint64_t number = next_draws++;
  return Draws(fixed_seed ? *fixed_seed : derive_seed(seed, Stream::crowd_behavior, number));
}

std::uint8_t BehaviorContext::require_state(const Element& element, std::string_view attribute,
                                            const std::string& name) const {
  const auto found = std::find(state_names.begin(), state_names.end(), name);
  if (found == state_names.end()) {
    element.fail_attribute(attribute, in_quotes(name),
                           fmt::format("the name of a state: {}", fmt::join(state_names, ", ")));
  }
  return static_cast<std::uint8_t>(found - state_names.begin());
}

std::vector<std::string> load_state_names(const Element& bfsm) {
  constexpr std::size_t kMostStates = std::numeric_limits<std::uint8_t>::max();
  std::vector<std::string> names;
  for (const Element& child : bfsm.children()) {
    if (child.name() != "State") continue;
    names.push_back(Attributes(child, state_attributes()).text("name"));
    if (std::count(names.begin(), names.end(), names.back()) > 1) {
      child.fail_attribute("name", in_quotes(names.back()) + " again", "a name of its own");
    }
    if (names.size() > kMostStates) {
      child.fail("one more state", fmt::format("at most {} states", kMostStates));
    }
  }
  if (names.empty()) bfsm.fail("no states", "at least one <State>");
  return names;
}

Behavior load_behavior(const Element& bfsm, const std::vector<std::string>& state_names,
                       std::uint64_t seed, Crowd& crowd) {
  const Attributes no_attributes(bfsm, {});
  for (const Element& child : bfsm.children()) {
    if (child.name() == "GoalSet") crowd.goals.load_set(child);
  }
  BehaviorContext context{crowd, crowd.goals, state_names, crowd.agents.count(), seed};
  Behavior behavior;
  std::vector<Element> transitions;
  for (const Element& child : bfsm.children()) {
    if (child.name() == "State") {
      behavior.states.push_back(load_state(child, context));
    } else if (child.name() == "Transition") {
      transitions.push_back(child);
    } else if (child.name() == "VelModifier") {
      make_another(vel_modifier_registry(), child, context, behavior.modifiers);
    } else if (child.name() != "GoalSet") {
      child.fail_unknown("<GoalSet>, <State>, <Transition> or <VelModifier>");
    }
  }
  for (const Element& transition : transitions) load_transitions(transition, context, behavior);
  behavior.processes = std::move(context.processes);
  return behavior;
}

}  // namespace throng::crowd
