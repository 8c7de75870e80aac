// Who takes part in a run: all of the scenario's people, or a random share of them.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/error.h"
#include "world/scenario.h"
#include "world/trace.h"

namespace throng::sim {

/// A role for each of `agents` agents: the scenario's disasters, `people` persons drawn by the seed
/// (all when it is not given) and the rest absent. A larger draw with the same seed holds every
/// smaller one. Adds to `problems` what cannot be.
std::vector<world::AgentRole> choose_roles(const world::Scenario& scenario, std::size_t agents,
                                           std::optional<int> people, std::uint64_t seed,
                                           std::vector<Problem>& problems);

}  // namespace throng::sim
