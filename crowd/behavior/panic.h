// Panic, and how it spreads from one to another.
#pragma once

#include <memory>
#include <vector>

#include "crowd/behavior.h"

namespace throng::crowd {

/// Attributes of <Panic> in a behavior file.
struct PanicSpec {
  float radius_m = 3;         ///< how far somebody's panic is noticed
  double rate_per_s = 0.2;    ///< chance in a second to catch it from each who panics nearby
  double recovery_per_s = 0;  ///< chance in a second to calm down
  float speed_factor = 1.5F;  ///< of the preferred speed while in panic
};

AttributeTable panic_attributes();

/// Throws InputError.
PanicSpec load_panic(const Element& element);

/// Spreads and calms panic once in a step, as a stochastic epidemic in space (susceptible,
/// infected, susceptible again): with n in panic within the radius, somebody calm panics in a
/// step with probability 1 - exp(-rate n dt). Each agent's fate depends on the seed, the step
/// and the id only.
std::unique_ptr<Process> make_panic_contagion(const PanicSpec& spec, std::uint64_t seed);

/// Makes those in panic hurry.
std::unique_ptr<VelModifier> make_panic_modifier(const PanicSpec& spec);

/// panicked: true for who is in panic.
std::vector<ConditionRegistry::Entry> panic_conditions();
/// panic, calm: begin and end it on entry into a state.
std::vector<ActionRegistry::Entry> panic_actions();

}  // namespace throng::crowd
