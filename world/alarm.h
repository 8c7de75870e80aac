// When the alarm of a scenario is, and which states of its behavior only people who know of it
// reach.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace throng::world {

struct Scenario;

struct Alarm {
  /// The earliest start of a disaster; where the scenario places none, the earliest start of the
  /// behavior's conditions "proximity" (s). Empty: nothing ever happens here.
  std::optional<double> at_s;
  /// Names of the states that are reached only through a transition whose condition asks for the
  /// reach of a disaster, for panic or for a guide, or of an event that changes states; states of
  /// people who cannot stand are left out. Empty where the behavior has no such transition.
  std::vector<std::string> aware_states = {};

  bool operator==(const Alarm&) const = default;
};

/// Scenario::alarm if it is known, else from the scenario's scene and behavior, if it has a crowd.
/// Throws EnvironmentError for files that cannot be read and InputError for files that are not
/// well-formed.
Alarm find_alarm(const Scenario& scenario);

}  // namespace throng::world
