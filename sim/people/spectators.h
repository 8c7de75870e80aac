// People on stands and on props, who are added to the crowd of a run.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/error.h"
#include "sim/people/crowd_source.h"
#include "world/scenario.h"

namespace throng::sim {

/// Adds the spectators of a scenario's stands and its sitters to a crowd, and their states
/// "sitting", "standing", "cheering" and "leaving" after its states. People who stay follow the
/// crowd's agents. People who leave are its last agents, who arrive at the feet of aisles
/// (world::departures(), stand by stand): until then they are shown on the stand. The crowd knows
/// only of those who have arrived. In a recording everybody stays. Their behavior depends on the
/// seed. Returns the crowd itself if there are none. Adds a problem if the crowd lacks the agents.
std::unique_ptr<CrowdSource> with_spectators(std::unique_ptr<CrowdSource> crowd,
                                             const world::Scenario& scenario, std::uint64_t seed,
                                             std::vector<Problem>& problems);

}  // namespace throng::sim
