// Runs the state machine: who changes state when, and where everybody wants to go.
#pragma once

#include <optional>
#include <string_view>

#include "crowd/behavior.h"

namespace throng::crowd {

class Machine {
 public:
  explicit Machine(Behavior behavior, std::size_t agent_count);

  /// Puts every agent that is there into its start state and makes it face where it wants to go.
  void start(Crowd& crowd);

  /// Takes every transition that is due. The first conditions are evaluated by all in the same
  /// world; then agents move on in the order of their ids, since they share goals' capacities. An
  /// agent follows a chain of transitions, but enters no state twice in a step. In compatible runs
  /// agents both look and move on in the order of their ids, since some of the elements that were
  /// added to Menge change with every look.
  void take_transitions(Crowd& crowd);

  /// Puts an agent into a state from outside, as if a transition led there.
  void change_state(Crowd& crowd, std::size_t agent, std::uint8_t state);

  /// An agent that was awaited is there now: puts it into its start state.
  void arrive(Crowd& crowd, std::size_t agent);

  /// Gives an agent another goal than its state's selector chose on entry.
  void change_goal(Crowd& crowd, std::size_t agent, int goal);
  const GoalSelector* goal_selector(std::uint8_t state) const {
    return behavior_.states[state].goal->selector();
  }

  /// Raises the signals of this name; whether there are any.
  bool fire(std::string_view name);

  /// Runs the processes beside the agents' decisions, before them and after the agents have moved.
  void run_processes_before(Crowd& crowd);
  void run_processes_after(Crowd& crowd);

  /// Sets everybody's preferred velocity.
  void prefer(Crowd& crowd) const;

  bool is_final(std::uint8_t state) const { return behavior_.states[state].final; }
  std::optional<bool> is_lying(std::uint8_t state) const { return behavior_.states[state].lying; }
  /// Whether any transition leads out of a state.
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
