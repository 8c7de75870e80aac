// People on stands, who are added to the crowd of a run.
#pragma once

#include <cstdint>
#include <memory>

#include "sim/people/crowd_source.h"
#include "world/scenario.h"

namespace throng::sim {

/// Number of spectators who are not agents of the crowd: they follow its agents.
std::size_t count_spectators(const world::Scenario& scenario);

/// Adds the spectators of a scenario's stands to a crowd, after its agents, and their states
/// "sitting", "standing" and "cheering" after its states. Their behavior depends on the seed. The
/// crowd itself does not know of them. Returns the crowd itself if there are none.
std::unique_ptr<CrowdSource> with_spectators(std::unique_ptr<CrowdSource> crowd,
                                             const world::Scenario& scenario, std::uint64_t seed);

}  // namespace throng::sim
