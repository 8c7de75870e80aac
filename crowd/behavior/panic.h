// Panic and its contagion.
#pragma once

#include <memory>
#include <vector>

#include "crowd/state/behavior.h"

namespace throng::crowd {

/// Attributes of <Panic> in a behavior file.
struct PanicSpec {
  float radius_m = 3;         ///< max distance at which panic is noticed
  double rate_per_s = 0.2;    ///< rate of contagion per person in panic within radius_m
  double recovery_per_s = 0;  ///< rate of calming down
  float speed_factor = 1.5F;  ///< factor of the preferred speed during panic
};

AttributeTable panic_attributes();

/// Throws InputError.
PanicSpec load_panic(const Element& element);

/// Creates the process that spreads and ends panic, once per step: a stochastic spatial epidemic
/// (susceptible, infected, susceptible). With n people in panic within the radius, a calm person
/// panics with probability 1 - exp(-rate n dt). Results depend only on the seed, the step and the
/// id.
std::unique_ptr<Process> make_panic_contagion(const PanicSpec& spec, std::uint64_t seed);

/// Creates the modifier that increases the speed of people in panic.
std::unique_ptr<VelModifier> make_panic_modifier(const PanicSpec& spec);

/// The condition panicked: the agent is in panic.
std::vector<ConditionRegistry::Entry> panic_conditions();
/// The actions panic and calm: begin and end panic when an agent enters a state.
std::vector<ActionRegistry::Entry> panic_actions();

}  // namespace throng::crowd
