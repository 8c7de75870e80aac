// Execution of the state machine: transitions and preferred velocities.
#pragma once

#include <optional>
#include <string_view>

#include "crowd/state/behavior.h"

namespace throng::crowd {

/// Runs a Behavior for all agents.
class Machine {
 public:
  explicit Machine(Behavior behavior, std::size_t agent_count);

  /// Puts each present agent into its initial state.
  void start(Crowd& crowd);

  /// Before the first step: begins the processes, and makes each agent face its preferred
  /// direction.
  void prepare_to_step(Crowd& crowd);

  /// Takes all transitions whose conditions hold. The first conditions are evaluated for all agents
  /// in the same state of the crowd; then agents change states in the order of their ids, because
  /// goals have capacities. An agent follows a chain of transitions but enters no state twice in a
  /// step. In compatible runs, agents evaluate conditions and change states one after the other,
  /// because some elements added to Menge change with each evaluation.
  void take_transitions(Crowd& crowd);

  /// Puts an agent into a state, as a transition does.
  void change_state(Crowd& crowd, std::size_t agent, std::uint8_t state);

  /// Puts an awaited agent that has arrived into its initial state.
  void arrive(Crowd& crowd, std::size_t agent);

  /// Replaces the goal that the state's selector chose.
  void change_goal(Crowd& crowd, std::size_t agent, int goal);
  GoalSelector* goal_selector(std::uint8_t state) const {
    return behavior_.states[state].goal->selector();
  }

  /// Raises the signals with this name. Returns whether there are any.
  bool fire(std::string_view name);

  /// Run the processes before the agents' decisions and after their motion.
  void run_processes_before(Crowd& crowd);
  void run_processes_after(Crowd& crowd);

  /// Sets the preferred velocities of all agents.
  void prefer(Crowd& crowd) const;

  bool is_final(std::uint8_t state) const { return behavior_.states[state].final; }
  std::optional<bool> is_lying(std::uint8_t state) const { return behavior_.states[state].lying; }
  /// Whether a transition leads out of a state.
  bool has_exits(std::uint8_t state) const { return !behavior_.states[state].transitions.empty(); }

 private:
  static constexpr int kNone = -1;

  int due_transition(const Crowd& crowd, std::size_t agent) const;
  void follow_chain(Crowd& crowd, std::size_t agent, int transition);
  void enter(Crowd& crowd, std::size_t agent, std::uint8_t state);
  void leave(Crowd& crowd, std::size_t agent);
  void prefer(Crowd& crowd, std::size_t agent) const;
  static void face_the_way(Agents& agents, std::size_t agent);

  Behavior behavior_;
  std::vector<int> due_;  // per agent
};

}  // namespace throng::crowd
