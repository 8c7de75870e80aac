// Warnings about suspicious but valid parts of a behavior file, with line numbers.
#pragma once

#include <string>
#include <vector>

#include "crowd/state/behavior.h"

namespace throng::crowd {

/// Records the elements of a behavior while it is read, and checks them at the end.
class Diagnosis {
 public:
  /// Records the next state.
  void note_state(const Element& element) { states_.push_back(element); }
  /// Records the next transition of state `from`.
  void note_transition(const Element& element, std::uint8_t from);
  void note_goal_set(const Element& element, int set) { goal_sets_.push_back({element, set}); }

  /// Warns of states that cannot be left or reached, transitions that are never evaluated or that
  /// form a cycle in each step, and empty or unused goal sets. `from_outside`: states that agents
  /// enter other than by transitions.
  void report(const Crowd& crowd, const Behavior& behavior,
              const std::vector<std::string>& state_names,
              const std::vector<std::uint8_t>& from_outside) const;

 private:
  struct NotedSet {
    Element element;
    int set = 0;
  };

  void report_dead_ends(const Behavior& behavior) const;
  void report_unreachable(const Crowd& crowd, const Behavior& behavior,
                          const std::vector<std::uint8_t>& from_outside) const;
  void report_transitions(const Behavior& behavior,
                          const std::vector<std::string>& state_names) const;
  void report_goal_sets(const Goals& goals) const;

  std::vector<Element> states_;
  std::vector<std::vector<Element>> transitions_;  // by state
  std::vector<NotedSet> goal_sets_;
};

}  // namespace throng::crowd
