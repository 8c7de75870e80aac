// The alarm of a scenario: its time, and the behavior states that only informed people enter.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace throng::world {

struct Scenario;

struct Alarm {
  /// The earliest start of a disaster (s); if the scenario defines no disaster, the earliest start
  /// of the "proximity" conditions of the behavior. Empty if nothing ever happens.
  std::optional<double> at_s;
  /// Names of the states that people enter only through a transition whose condition tests for a
  /// disaster, panic or a guide, or through an event that changes states. States in which people
  /// lie on the ground are excluded. Empty if the behavior has no such transition.
  std::vector<std::string> aware_states = {};

  bool operator==(const Alarm&) const = default;
};

/// Returns Scenario::alarm if it is set; otherwise derives the alarm from the disasters and, if the
/// scenario has a crowd, from the scene and behavior. Throws EnvironmentError for files that cannot
/// be read and InputError for malformed files.
Alarm find_alarm(const Scenario& scenario);

}  // namespace throng::world
