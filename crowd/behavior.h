// The state machine: what the plug-in points do, and a behavior file in memory.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "crowd/behavior/state_goal.h"
#include "crowd/crowd.h"
#include "crowd/elements/registry.h"
#include "crowd/elements/sampler.h"
#include "crowd/process.h"

namespace throng::crowd {

/// Whether an agent leaves its state. Values that belong to an agent are sampled or looked up when
/// the agent enters the state; queries may be repeated and come from several threads.
class Condition {
 public:
  virtual ~Condition() = default;
  /// An agent enters the state that this may lead out of. Called for one agent at a time.
  virtual void enter(const Crowd&, std::size_t /*agent*/) {}
  virtual bool holds(const Crowd& crowd, std::size_t agent) const = 0;
  /// Whether it holds for everybody at any time, as far as the file tells.
  virtual bool is_always() const { return false; }
};

struct PreferredVelocity {
  Eigen::Vector2f direction;  ///< unit
  float speed = 0;            ///< m/s
};

/// Computes an agent's preferred velocity. Fields that it does not set keep their values.
class VelComponent {
 public:
  virtual ~VelComponent() = default;
  /// An agent enters a state with this component; its goal is set. Called for one agent at a time.
  virtual void enter(const Crowd&, std::size_t /*agent*/) {}
  /// Called for different agents at once: what it remembers, it remembers per agent.
  virtual void prefer(const Crowd& crowd, std::size_t agent, PreferredVelocity& preferred) = 0;
};

/// Changes what a VelComponent said.
class VelModifier {
 public:
  virtual ~VelModifier() = default;
  virtual void modify(const Crowd& crowd, std::size_t agent,
                      PreferredVelocity& preferred) const = 0;
};

/// Changes an agent on entry into a state and, if it is to be undone, on leaving it. Called for
/// one agent at a time.
class Action {
 public:
  virtual ~Action() = default;
  virtual void enter(Crowd& crowd, std::size_t agent) = 0;
  virtual void leave(Crowd& crowd, std::size_t agent) = 0;
};

/// The state that a transition leads to.
class Target {
 public:
  virtual ~Target() = default;
  /// Called for one agent at a time.
  virtual std::uint8_t state(const Crowd& crowd, std::size_t agent) = 0;
  /// Adds the states that it may lead to; need not name those that an agent has been in anyway.
  virtual void list_states(std::vector<std::uint8_t>&) const {}
};

/// Something from outside that events wait for, see Simulation::fire.
struct Signal {
  std::string name;
  bool raised = false;
};

struct Transition {
  std::unique_ptr<Condition> condition;
  std::unique_ptr<Target> target;
};

struct MachineState {
  bool final = false;
  std::optional<bool> lying;        ///< whether people lie on the ground in it, if it says so
  std::shared_ptr<StateGoal> goal;  ///< several states may share one
  std::unique_ptr<VelComponent> velocity;
  std::vector<std::unique_ptr<Action>> actions;
  std::vector<std::unique_ptr<VelModifier>> modifiers;
  std::vector<Transition> transitions;  ///< in the file's order; the first that holds is taken
};

struct Behavior {
  std::vector<MachineState> states;
  std::vector<std::unique_ptr<VelModifier>> modifiers;  ///< of all states, after the state's own
  std::vector<std::unique_ptr<Process>> processes;      ///< in the file's order
  std::vector<std::shared_ptr<Signal>> signals;
  /// By Agents::profile, after all others.
  std::vector<std::vector<std::unique_ptr<VelModifier>>> profile_modifiers;
};

class Stress;

/// Objects that factories of plug-ins may need.
struct BehaviorContext {
  const Crowd& crowd;  ///< with its agents, obstacles and goals
  const Goals& goals;
  const std::vector<std::string>& state_names;
  std::size_t agent_count = 0;
  std::uint64_t seed = 1;
  MengeSequences& sequences;  ///< of random numbers, of compatible runs
  std::vector<std::shared_ptr<MengeRandom>> set_sequences = {};  ///< the same, per goal set
  std::vector<std::unique_ptr<Process>> processes = {};          ///< what plug-ins want to be run
  std::uint64_t next_draws = 0;  ///< elements that draw are numbered in the file's order
  /// A transition from several states is read once for each; this is not the first time. Elements
  /// that draw have the numbers that they had then.
  bool is_copy = false;
  std::vector<std::shared_ptr<Signal>> signals = {};  ///< that triggers wait for
  /// Set by a goal selector that shares the one of another state.
  std::optional<std::uint8_t> shares_goal_of = {};
  Stress* stress = nullptr;  ///< the process that stresses agents, once an element needs it
  /// Into these something else than transitions may put agents.
  std::vector<std::uint8_t> states_from_outside = {};

  /// The random numbers of one more element; `fixed_seed` is its own seed, if it gives one.
  Draws make_draws(std::optional<std::uint64_t> fixed_seed = {});
  Sampler make_sampler(const Distribution& distribution);
  Sampler2 make_sampler(const Distribution2& distribution);
  /// Uniform in [0, 1).
  Sampler make_unit_sampler() { return make_sampler({Distribution::Kind::uniform, 0, 1, {}}); }
  /// The same for choosing among the goals of a set: in compatible runs all who do so share the
  /// set's sequence.
  Sampler make_set_sampler(int set);
  /// Throws InputError for a name that is no state's.
  std::uint8_t require_state(const Element& element, std::string_view attribute,
                             const std::string& name) const;
};

using ConditionRegistry = Registry<Condition, BehaviorContext>;
using GoalSelectorRegistry = Registry<GoalSelector, BehaviorContext>;
using VelComponentRegistry = Registry<VelComponent, BehaviorContext>;
using VelModifierRegistry = Registry<VelModifier, BehaviorContext>;
using ActionRegistry = Registry<Action, BehaviorContext>;
using TargetRegistry = Registry<Target, BehaviorContext>;
using TaskRegistry = Registry<Process, BehaviorContext>;

const ConditionRegistry& condition_registry();
const GoalSelectorRegistry& goal_selector_registry();
const VelComponentRegistry& vel_component_registry();
const VelModifierRegistry& vel_modifier_registry();
const ActionRegistry& action_registry();
const TargetRegistry& target_registry();
/// There are none; Menge's came from plug-ins.
const TaskRegistry& task_registry();

/// The groups that make up the conditions, one file each.
std::vector<ConditionRegistry::Entry> general_conditions();
std::vector<ConditionRegistry::Entry> place_conditions();
/// clear_AABB.
std::vector<ConditionRegistry::Entry> aircraft_conditions();
/// follow, via and proximity: flight from a disaster and following something that leads out
/// (Huang 2016), with distances, growth and probabilities as the attributes say.
std::vector<ConditionRegistry::Entry> evacuation_conditions();

/// The groups that make up the goal selectors.
std::vector<GoalSelectorRegistry::Entry> plain_goal_selectors();
/// exit_choice.
std::vector<GoalSelectorRegistry::Entry> evacuation_goal_selectors();

/// The groups that make up the actions.
std::vector<ActionRegistry::Entry> property_actions();
std::vector<ActionRegistry::Entry> obstacle_actions();
/// add_obstacle_at.
std::vector<ActionRegistry::Entry> late_obstacle_actions();
std::vector<ActionRegistry::Entry> stress_actions();
/// leave.
std::vector<ActionRegistry::Entry> presence_actions();
/// formation.
std::vector<VelModifierRegistry::Entry> formation_modifiers();
/// `exit_reset`, which actions have whose change can be undone.
AttributeSpec exit_reset_attribute();

/// The names of a behavior file's states, in its order. Throws InputError when two are equal.
std::vector<std::string> load_state_names(const Element& bfsm);
/// Reads goals into the crowd, then states and transitions; `profile_modifiers` are the scene's,
/// by profile. Throws InputError.
Behavior load_behavior(const Element& bfsm, const std::vector<std::string>& state_names,
                       const std::vector<std::vector<Element>>& profile_modifiers,
                       MengeSequences& sequences, Crowd& crowd);

}  // namespace throng::crowd
