// The people of a run before its first step.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "base/error.h"
#include "sim/people/crowd_source.h"
#include "spec/sim/run_spec.h"
#include "world/scenario.h"
#include "world/trace.h"

namespace throng::sim {

/// The crowd of a run and the roles of its agents.
struct StartingPeople {
  std::unique_ptr<CrowdSource> crowd;  ///< only participants are present
  std::vector<world::AgentRole> roles;

  /// Positions (m) of the persons who are present.
  std::vector<Eigen::Vector2d> places() const;
};

/// Loads the crowd or the recording of a run and chooses its participants. Adds the problems of
/// choose_roles() to `problems`. Throws InputError if the crowd cannot be loaded. Without
/// `can_step` it is load_people() whose crowd is loaded.
StartingPeople starting_people(const world::Scenario& scenario, const RunSpec& spec,
                               std::vector<Problem>& problems, bool can_step = true);

}  // namespace throng::sim
