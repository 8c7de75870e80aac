// The state machine: interfaces of its plug-ins, and a behavior file in memory.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "crowd/elements/menge_sequences.h"
#include "crowd/elements/registry.h"
#include "crowd/elements/sampler.h"
#include "crowd/state/crowd.h"
#include "crowd/state/process.h"
#include "crowd/state/state_goal.h"

namespace throng::crowd {

/// The condition of a transition. Values per agent are sampled or looked up when the agent enters
/// the state. holds() may be called repeatedly and from several threads.
class Condition {
 public:
  virtual ~Condition() = default;
  /// Called when an agent enters a state from which the transition leads; for one agent at a time.
  virtual void enter(const Crowd&, std::size_t /*agent*/) {}
  virtual bool holds(const Crowd& crowd, std::size_t agent) const = 0;
  /// Whether the condition always holds for all agents, as far as the file determines.
  virtual bool is_always() const { return false; }
};

struct PreferredVelocity {
  Eigen::Vector2f direction;  ///< unit
  float speed = 0;            ///< m/s
};

/// Computes an agent's preferred velocity; fields that it does not set keep their values.
class VelComponent {
 public:
  virtual ~VelComponent() = default;
  /// Called when an agent enters a state with this component and has its goal; for one agent at a
  /// time.
  virtual void enter(const Crowd&, std::size_t /*agent*/) {}
  /// Called for several agents concurrently; mutable data must be per agent.
  virtual void prefer(const Crowd& crowd, std::size_t agent, PreferredVelocity& preferred) = 0;
};

/// Modifies the preferred velocity that a VelComponent computed.
class VelModifier {
 public:
  virtual ~VelModifier() = default;
  virtual void modify(const Crowd& crowd, std::size_t agent,
                      PreferredVelocity& preferred) const = 0;
};

/// Changes an agent when it enters a state and can revert the change when the agent leaves it.
/// Called for one agent at a time.
class Action {
 public:
  virtual ~Action() = default;
  virtual void enter(Crowd& crowd, std::size_t agent) = 0;
  virtual void leave(Crowd& crowd, std::size_t agent) = 0;
};

/// Determines the state to which a transition leads.
class Target {
 public:
  virtual ~Target() = default;
  /// Called for one agent at a time.
  virtual std::uint8_t state(const Crowd& crowd, std::size_t agent) = 0;
  /// Adds the states to which it may lead; states that the agent was in before may be omitted.
  virtual void list_states(std::vector<std::uint8_t>&) const {}
};

/// An external signal that triggers events, see Simulation::fire().
struct Signal {
  std::string name;
  bool raised = false;
};

/// A transition out of a state.
struct Transition {
  std::unique_ptr<Condition> condition;
  std::unique_ptr<Target> target;
};

/// A state of a behavior.
struct MachineState {
  bool final = false;
  std::optional<bool> lying;        ///< whether people in it lie on the ground, if declared
  std::shared_ptr<StateGoal> goal;  ///< may be shared by several states
  std::unique_ptr<VelComponent> velocity;
  std::vector<std::unique_ptr<Action>> actions;
  std::vector<std::unique_ptr<VelModifier>> modifiers;
  /// In the order of the file; the first whose condition holds is taken.
  std::vector<Transition> transitions;
};

/// A behavior file in memory.
struct Behavior {
  std::vector<MachineState> states;
  /// Apply in all states, after those of the state.
  std::vector<std::unique_ptr<VelModifier>> modifiers;
  std::vector<std::unique_ptr<Process>> processes;  ///< in the order of the file
  std::vector<std::shared_ptr<Signal>> signals;
  /// Indexed by Agents::profile; apply after all others.
  std::vector<std::vector<std::unique_ptr<VelModifier>>> profile_modifiers;
};

class Stress;

/// Objects that factories of plug-ins may use.
struct BehaviorContext {
  const Crowd& crowd;  ///< agents, obstacles and goals are loaded
  const Goals& goals;
  const std::vector<std::string>& state_names;
  std::size_t agent_count = 0;
  std::uint64_t seed = 1;
  MengeSequences& sequences;  ///< sequences of random numbers, for compatible runs
  /// Sequences per goal set, for compatible runs.
  std::vector<std::shared_ptr<MengeRandom>> set_sequences = {};
  std::vector<std::unique_ptr<Process>> processes = {};  ///< processes that plug-ins add
  /// Number of the next element that samples, in the order of the file.
  std::uint64_t next_draws = 0;
  /// Whether this is a copy: a transition from several states is read once for each of them.
  /// Elements that sample have the same numbers as in the first reading.
  bool is_copy = false;
  std::vector<std::shared_ptr<Signal>> signals = {};  ///< signals of external triggers
  /// Set by a goal selector that shares the goals of another state.
  std::optional<std::uint8_t> shares_goal_of = {};
  Stress* stress = nullptr;  ///< the process for stress; null until an element needs it
  /// States into which events or other processes may put agents.
  std::vector<std::uint8_t> states_from_outside = {};

  /// Returns the random numbers for the next element that samples. `fixed_seed`: seed that the
  /// element sets.
  Draws make_draws(std::optional<std::uint64_t> fixed_seed = {});
  Sampler make_sampler(const Distribution& distribution);
  Sampler2 make_sampler(const Distribution2& distribution);
  /// Returns a sampler of uniform numbers in [0, 1).
  Sampler make_unit_sampler() { return make_sampler({Distribution::Kind::uniform, 0, 1, {}}); }
  /// Returns a sampler of uniform numbers for choosing among the goals of a set; in compatible
  /// runs, all selectors of a set share its sequence.
  Sampler make_set_sampler(int set);
  /// Returns the index of a state. Throws InputError if there is no state with this name.
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
/// Returns an empty registry: Menge's tasks came from plug-ins.
const TaskRegistry& task_registry();

/// Groups of conditions, one per source file.
std::vector<ConditionRegistry::Entry> general_conditions();
std::vector<ConditionRegistry::Entry> place_conditions();
/// The condition clear_AABB.
std::vector<ConditionRegistry::Entry> aircraft_conditions();
/// The conditions follow, via and proximity: flight from a disaster and following a guide (Huang et
/// al. 2016), with distances, growth and probabilities as attributes.
std::vector<ConditionRegistry::Entry> evacuation_conditions();

/// Groups of goal selectors, one per source file.
std::vector<GoalSelectorRegistry::Entry> plain_goal_selectors();
/// The goal selector exit_choice.
std::vector<GoalSelectorRegistry::Entry> evacuation_goal_selectors();

/// Groups of actions, one per source file.
std::vector<ActionRegistry::Entry> property_actions();
std::vector<ActionRegistry::Entry> obstacle_actions();
/// The action add_obstacle_at.
std::vector<ActionRegistry::Entry> late_obstacle_actions();
std::vector<ActionRegistry::Entry> stress_actions();
/// The action leave.
std::vector<ActionRegistry::Entry> presence_actions();
/// The velocity modifier formation.
std::vector<VelModifierRegistry::Entry> formation_modifiers();
/// Returns the attribute `exit_reset` of actions whose change can be reverted.
AttributeSpec exit_reset_attribute();

}  // namespace throng::crowd
