#include "crowd/behavior/load_behavior.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>

#include "crowd/behavior/closing_door.h"
#include "crowd/behavior/diagnosis.h"
#include "crowd/behavior/events.h"
#include "crowd/behavior/panic.h"

namespace throng::crowd {

namespace {

AttributeTable state_attributes() {
  return {text("name", "a name that no other state has"),
          boolean("final", "1: the run may end when everyone is in such states"),
          optional(boolean("lying",
                           "1: people in this state lie on the ground; without it the name of the "
                           "state decides (docs/trace.md)"))};
}

/// Always the same state: the `to` of a transition.
class Fixed : public Target {
 public:
  explicit Fixed(std::uint8_t state) : state_(state) {}
  std::uint8_t state(const Crowd&, std::size_t) override { return state_; }
  void list_states(std::vector<std::uint8_t>& states) const override { states.push_back(state_); }

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

/// A state whose goals are those of another.
struct SharedGoal {
  Element element;
  std::size_t state = 0;
  std::size_t of = 0;
};

void load_goal_selector(const Element& element, BehaviorContext& context, std::size_t state,
                        std::shared_ptr<StateGoal>& place, std::vector<SharedGoal>& shared) {
  if (place) element.fail("a second <GoalSelector>", "at most one <GoalSelector>");
  element.require_no_children();
  const GoalSelectorRegistry::Entry& entry = goal_selector_registry().find(element);
  const Attributes attributes(element, entry.attributes);
  context.shares_goal_of.reset();
  place =
      std::make_shared<StateGoal>(entry.make(element, attributes, context), context.agent_count);
  if (attributes.boolean("persistent")) place->make_persistent();
  if (context.shares_goal_of) shared.push_back({element, state, *context.shares_goal_of});
}

MachineState load_state(const Element& element, BehaviorContext& context, std::size_t index,
                        std::vector<SharedGoal>& shared) {
  const Attributes attributes(element, state_attributes());
  MachineState state;
  state.final = attributes.boolean("final");
  if (attributes.has("lying")) state.lying = attributes.boolean("lying");
  for (const Element& child : element.children()) {
    if (child.name() == "GoalSelector") {
      load_goal_selector(child, context, index, state.goal, shared);
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
  if (!state.goal) state.goal = std::make_shared<StateGoal>(nullptr, context.agent_count);
  return state;
}

/// Throws when states share their goals in a circle.
void share_goals(const std::vector<SharedGoal>& shared, Behavior& behavior) {
  std::vector<std::size_t> owner(behavior.states.size());
  for (std::size_t i = 0; i < owner.size(); ++i) owner[i] = i;
  for (const SharedGoal& share : shared) owner[share.state] = share.of;
  for (const SharedGoal& share : shared) {
    std::size_t of = share.of;
    for (std::size_t hops = 0; owner[of] != of || of == share.state; ++hops) {
      if (hops > owner.size() || of == share.state) {
        share.element.fail("states that share their goals in a circle",
                           "a state with a goal selector of its own");
      }
      of = owner[of];
    }
    behavior.states[share.state].goal = behavior.states[of].goal;
    behavior.states[of].goal->make_persistent();
  }
}

/// The names between the commas. Menge takes the spaces around them for parts of the names.
std::vector<std::string> split_names(const std::string& list, Compat compat) {
  std::vector<std::string> names;
  for (std::size_t begin = 0; begin <= list.size();) {
    const std::size_t end = std::min(list.find(',', begin), list.size());
    std::string name = list.substr(begin, end - begin);
    if (compat == Compat::none) {
      name.erase(0, std::min(name.find_first_not_of(' '), name.size()));
      name.erase(name.find_last_not_of(' ') + 1);
    }
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

/// A transition from several states is as many transitions, so that none remembers another's
/// agents.
void load_transitions(const Element& element, BehaviorContext& context, Behavior& behavior,
                      Diagnosis& diagnosis) {
  const Attributes attributes(element, {text("from", "names of states, separated by commas"),
                                        optional(text("to", "the name of a state"))});
  const std::uint64_t first_draws = context.next_draws;
  const std::uint64_t first_sequence = context.sequences.count();
  for (const std::string& name : split_names(attributes.text("from"), context.crowd.compat)) {
    const std::uint8_t from = context.require_state(element, "from", name);
    context.next_draws = first_draws;
    context.sequences.rewind(first_sequence);
    behavior.states[from].transitions.push_back(load_transition(element, attributes, context));
    diagnosis.note_transition(element, from);
    context.is_copy = true;
  }
  context.is_copy = false;
}

/// Moves the goals that have a path.
class MovingGoals : public Process {
 public:
  void after_motion(Crowd& crowd, Machine&) override { crowd.goals.advance_paths(crowd.dt_s); }
};

/// A behavior file that is being read. All goals are read first, since states refer to them; the
/// rest in the file's order, in which the elements that draw get their random numbers.
struct Loading {
  BehaviorContext& context;
  Behavior& behavior;
  Diagnosis& diagnosis;
  std::vector<int> goal_sets = {};  ///< indices, one per <GoalSet>
  std::size_t next_goal_set = 0;
  std::size_t next_state = 0;
  std::vector<SharedGoal> shared = {};
};

void load_goal_sets(const Element& bfsm, Goals& goals, Loading& loading) {
  for (const Element& child : bfsm.children()) {
    if (child.name() != "GoalSet") continue;
    loading.goal_sets.push_back(goals.load_set(child));
    loading.diagnosis.note_goal_set(child, loading.goal_sets.back());
    loading.context.set_sequences.push_back(std::make_shared<MengeRandom>(0));  // until its turn
  }
}

/// The next <GoalSet>'s turn to get random numbers; one that adds to another has none.
void take_goal_set(Loading& loading) {
  const auto here =
      loading.goal_sets.begin() + static_cast<std::ptrdiff_t>(loading.next_goal_set++);
  if (std::find(loading.goal_sets.begin(), here, *here) != here) return;
  if (const auto sequence = loading.context.sequences.next()) {
    *loading.context.set_sequences[static_cast<std::size_t>(*here)] = *sequence;
  }
}

void take_state(const Element& element, Loading& loading) {
  const std::size_t index = loading.next_state++;
  MachineState state = load_state(element, loading.context, index, loading.shared);
  state.transitions = std::move(loading.behavior.states[index].transitions);  // read before it
  loading.behavior.states[index] = std::move(state);
  loading.diagnosis.note_state(element);
}

void load_child(const Element& child, Loading& loading) {
  BehaviorContext& context = loading.context;
  if (child.name() == "State") {
    take_state(child, loading);
  } else if (child.name() == "Transition") {
    load_transitions(child, context, loading.behavior, loading.diagnosis);
  } else if (child.name() == "GoalSet") {
    take_goal_set(loading);
  } else if (child.name() == "VelModifier") {
    make_another(vel_modifier_registry(), child, context, loading.behavior.modifiers);
  } else if (child.name() == "EventSystem") {
    load_events(child, context);
  } else if (child.name() == "Task") {
    make_another(task_registry(), child, context, context.processes);
  } else if (child.name() == "ClosingDoor") {
    context.processes.push_back(make_closing_door(child, context));
  } else if (child.name() == "Panic") {
    const PanicSpec panic = load_panic(child);
    context.processes.push_back(make_panic_contagion(panic, context.seed));
    loading.behavior.modifiers.push_back(make_panic_modifier(panic));
  } else {
    child.fail_unknown(
        "<GoalSet>, <State>, <Transition>, <VelModifier>, <EventSystem>, <Task>, <ClosingDoor> or "
        "<Panic>");
  }
}

}  // namespace

std::vector<std::string> load_state_names(const Element& bfsm) {
  constexpr std::size_t kMaxStates = std::numeric_limits<std::uint8_t>::max();
  std::vector<std::string> names;
  for (const Element& child : bfsm.children()) {
    if (child.name() != "State") continue;
    const std::string_view name = child.attribute("name").value_or("");
    // Other findings about its attributes are reported when the state is made.
    names.push_back(name.empty() ? Attributes(child, state_attributes()).text("name")
                                 : std::string(name));
    if (std::count(names.begin(), names.end(), names.back()) > 1) {
      child.fail_attribute("name", in_quotes(names.back()) + " again", "a name of its own");
    }
    if (names.size() > kMaxStates) {
      child.fail("one more state", fmt::format("at most {} states", kMaxStates));
    }
  }
  if (names.empty()) bfsm.fail("no states", "at least one <State>");
  return names;
}

Behavior load_behavior(const Element& bfsm, const std::vector<std::string>& state_names,
                       const std::vector<std::vector<Element>>& profile_modifiers,
                       MengeSequences& sequences, Crowd& crowd) {
  const Attributes no_attributes(bfsm, {});
  Diagnosis diagnosis;
  Behavior behavior;
  behavior.states.resize(state_names.size());
  BehaviorContext context{crowd,      crowd.goals, state_names, crowd.agents.count(),
                          crowd.seed, sequences};
  Loading loading{context, behavior, diagnosis};
  load_goal_sets(bfsm, crowd.goals, loading);
  if (crowd.goals.any_path()) context.processes.push_back(std::make_unique<MovingGoals>());
  for (const std::vector<Element>& elements : profile_modifiers) {
    auto& modifiers = behavior.profile_modifiers.emplace_back();
    for (const Element& element : elements) {
      make_another(vel_modifier_registry(), element, context, modifiers);
    }
  }
  for (const Element& child : bfsm.children()) load_child(child, loading);
  share_goals(loading.shared, behavior);
  behavior.processes = std::move(context.processes);
  behavior.signals = std::move(context.signals);
  diagnosis.report(crowd, behavior, state_names, context.states_from_outside);
  return behavior;
}

}  // namespace throng::crowd
