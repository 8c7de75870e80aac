// Suspicious but valid parts of a behavior file: each yields a warning at load, with its line.
#pragma once

#include <string>
#include <vector>

#include "crowd/behavior.h"

namespace throng::crowd {

/// Records the lines of elements while the file is read, and checks the whole in the end.
class Diagnosis {
 public:
  /// The next state.
  void note_state(const Element& element) { states_.push_back(element); }
  /// The next transition of state `from`.
  void note_transition(const Element& element, std::uint8_t from);
  void note_goal_set(const Element& element, int set) { goal_sets_.push_back({element, set}); }

  /// Warns of states that cannot be left or reached, of transitions that are never looked at or go
  /// round in every step, and of goal sets that are empty or of no use. `from_outside`: states that
  /// something else than transitions leads to.
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
