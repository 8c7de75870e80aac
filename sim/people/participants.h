// The participants of a run: all of the scenario's people, or a random sample of them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/error.h"
#include "world/trace.h"

namespace throng::sim {

/// Returns a role for each of `agents` agents: `disaster_agents` are disasters, `people` of the
/// others, sampled by the seed (default: all), are persons, and the rest is absent. A larger sample
/// contains every smaller one with the same seed. Adds a problem for a disaster agent that does not
/// exist (naming `scenario`) and for more people than the scenario has.
std::vector<world::AgentRole> choose_roles(const std::string& scenario,
                                           std::span<const int> disaster_agents, std::size_t agents,
                                           std::optional<int> people, std::uint64_t seed,
                                           std::vector<Problem>& problems);

}  // namespace throng::sim
