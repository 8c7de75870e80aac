#include "crowd/behavior/diagnosis.h"

#include <fmt/core.h>

#include <optional>

namespace throng::crowd {

namespace {

std::vector<std::uint8_t> states_behind(const Transition& transition) {
  std::vector<std::uint8_t> states;
  transition.target->list_states(states);
  return states;
}

/// The first transition of a state that always holds, if there is one.
std::optional<std::size_t> first_always(const MachineState& state) {
  for (std::size_t i = 0; i < state.transitions.size(); ++i) {
    if (state.transitions[i].condition->is_always()) return i;
  }
  return std::nullopt;
}

/// The state that follows at once from a state if no other transition is due: per state, or
/// nothing.
std::vector<std::optional<std::uint8_t>> next_states(const Behavior& behavior) {
  std::vector<std::optional<std::uint8_t>> next(behavior.states.size());
  for (std::size_t i = 0; i < next.size(); ++i) {
    const auto always = first_always(behavior.states[i]);
    if (!always) continue;
    const std::vector<std::uint8_t> targets =
        states_behind(behavior.states[i].transitions[*always]);
    if (targets.size() == 1) next[i] = targets.front();
  }
  return next;
}

}  // namespace

void Diagnosis::note_transition(const Element& element, std::uint8_t from) {
  if (transitions_.size() <= from) transitions_.resize(from + std::size_t{1});
  transitions_[from].push_back(element);
}

void Diagnosis::report(const Crowd& crowd, const Behavior& behavior,
                       const std::vector<std::string>& state_names,
                       const std::vector<std::uint8_t>& from_outside) const {
  // Events from outside may also take agents out of any state.
  if (from_outside.empty()) report_dead_ends(behavior);
  report_unreachable(crowd, behavior, from_outside);
  report_transitions(behavior, state_names);
  report_goal_sets(crowd.goals);
}

void Diagnosis::report_dead_ends(const Behavior& behavior) const {
  for (std::size_t i = 0; i < behavior.states.size(); ++i) {
    const MachineState& state = behavior.states[i];
    if (state.final || !state.transitions.empty()) continue;
    states_[i].warn("a state that cannot be left and is not final",
                    "a <Transition> from it, or final=\"1\"");
  }
}

void Diagnosis::report_unreachable(const Crowd& crowd, const Behavior& behavior,
                                   const std::vector<std::uint8_t>& from_outside) const {
  std::vector<bool> reached(behavior.states.size());
  std::vector<std::uint8_t> waiting = from_outside;
  waiting.insert(waiting.end(), crowd.agents.state.begin(), crowd.agents.state.end());
  while (!waiting.empty()) {
    const std::uint8_t state = waiting.back();
    waiting.pop_back();
    if (reached[state]) continue;
    reached[state] = true;
    for (const Transition& transition : behavior.states[state].transitions) {
      transition.target->list_states(waiting);
    }
  }
  for (std::size_t i = 0; i < reached.size(); ++i) {
    if (reached[i]) continue;
    states_[i].warn("a state that nobody can get to",
                    "agents that start in it, or a <Transition> to it");
  }
}

void Diagnosis::report_transitions(const Behavior& behavior,
                                   const std::vector<std::string>& state_names) const {
  const auto next = next_states(behavior);
  std::vector<bool> reported(next.size());
  for (std::size_t i = 0; i < next.size(); ++i) {
    const auto always = first_always(behavior.states[i]);
    if (!always) continue;
    for (std::size_t j = *always + 1; j < transitions_[i].size(); ++j) {
      transitions_[i][j].warn(
          fmt::format("a transition from {} behind one that always holds", state_names[i]),
          "an order in which it may be taken");
    }
    // Follows the path from here; back at the start it is a circle.
    std::string path = state_names[i];
    std::size_t at = i;
    for (std::size_t hops = 0; hops < next.size() && next[at] && !reported[at]; ++hops) {
      at = *next[at];
      path += " -> " + state_names[at];
      if (at != i) continue;
      transitions_[i][*always].warn(
          fmt::format("transitions that always hold and lead in a circle: {}", path),
          "a condition that may be false");
      for (std::size_t j = i; !reported[j]; j = *next[j]) reported[j] = true;
      break;
    }
  }
}

void Diagnosis::report_goal_sets(const Goals& goals) const {
  for (const NotedSet& noted : goal_sets_) {
    if (goals.set(noted.set).goals.empty()) {
      noted.element.warn("an empty goal set", "at least one <Goal>");
    } else if (!goals.is_used(noted.set)) {
      noted.element.warn("a goal set that nothing uses", "an element that names it");
    }
  }
}

}  // namespace throng::crowd
