// People of a run, loaded from their scenario.
#pragma once

#include <cstdint>
#include <string>

#include "crowd/simulation.h"
#include "spec/sim/run_spec.h"
#include "world/scenario.h"

namespace throng::sim {

/// The pedestrian model of a run: that of `spec`, else that of the scenario, else `orca` in a
/// `compat` mode and `ttc` otherwise.
std::string model_for(const world::Scenario& scenario, const CrowdSpec& spec);

/// Loads the people of a run, to be counted and found where they start: prepare_to_step() makes
/// them the crowd of the run. Throws as crowd::Simulation's constructor.
crowd::Simulation load_people(const world::Scenario& scenario, std::uint64_t seed,
                              const CrowdSpec& spec);

}  // namespace throng::sim
