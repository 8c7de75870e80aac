// Participants of a run: all of the scenario's people, or a random share of them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/error.h"
#include "world/trace.h"

namespace throng::sim {

/// A role for each of `agents` agents: the scenario's (its id is for messages) disasters, `people`
/// persons sampled by the seed (all when it is not given) and the rest absent. A larger draw with
/// the same seed holds every smaller one. Adds to `problems` what cannot be.
std::vector<world::AgentRole> choose_roles(const std::string& scenario,
                                           std::span<const int> disaster_agents, std::size_t agents,
                                           std::optional<int> people, std::uint64_t seed,
                                           std::vector<Problem>& problems);

}  // namespace throng::sim
