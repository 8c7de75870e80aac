// Behavior files: states, transitions and goals, read into the state machine.
#pragma once

#include <string>
#include <vector>

#include "crowd/elements/menge_sequences.h"
#include "crowd/state/behavior.h"

namespace throng::crowd {

/// Returns the names of a behavior file's states in the order of the file. Throws InputError for
/// duplicates.
std::vector<std::string> load_state_names(const Element& bfsm);
/// Reads goals into the crowd, then states and transitions. `profile_modifiers` are those of the
/// scene, indexed by profile. Throws InputError.
Behavior load_behavior(const Element& bfsm, const std::vector<std::string>& state_names,
                       const std::vector<std::vector<Element>>& profile_modifiers,
                       MengeSequences& sequences, Crowd& crowd);

}  // namespace throng::crowd
