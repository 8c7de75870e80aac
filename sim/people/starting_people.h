// The people of a run before its first step.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/error.h"
#include "crowd/simulation.h"
#include "sim/people/crowd_source.h"
#include "spec/sim/run_spec.h"
#include "world/scenario.h"
#include "world/trace.h"

namespace throng::sim {

/// The crowd of a run and the roles of its agents.
struct StartingPeople {
  std::unique_ptr<CrowdSource> crowd;  ///< only participants are present
  std::vector<world::AgentRole> roles;
};

/// Chooses the participants of a run from the crowd or the recording. Without `people`, which are
/// load_people() of this run, the crowd is loaded. Adds the problems of choose_roles() to
/// `problems`. Throws InputError if the crowd cannot be loaded.
StartingPeople starting_people(const world::Scenario& scenario, const RunSpec& spec,
                               std::vector<Problem>& problems,
                               std::optional<crowd::Simulation> people = std::nullopt);

/// The roles of a run's agents. Adds the problems of choose_roles() to `problems`.
std::vector<world::AgentRole> starting_roles(const world::Scenario& scenario, const RunSpec& spec,
                                             std::size_t agents, std::vector<Problem>& problems);

/// Positions (m) of the persons who are present.
std::vector<Eigen::Vector2d> places_of_persons(const std::vector<world::AgentRole>& roles,
                                               std::span<const Eigen::Vector2f> positions,
                                               std::span<const std::uint8_t> present);

}  // namespace throng::sim
