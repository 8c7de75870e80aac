// The ground on the two sides of each exit of a scenario.
#pragma once

#include <vector>

#include "places/scenarios/check/survey.h"
#include "world/scenario.h"

namespace throng::scenarios {

struct ExitSides {
  /// Walls enclose the ground behind the exit, and no exit leads on from there.
  bool is_dead_end = false;
  /// With all exits closed, walls enclose the ground before the exit, and a way leads from there to
  /// the ground behind it.
  bool has_way_around = false;
};

/// The sides of each exit. Neither flag is set for exits that are closed or blocked. Ground
/// farther than 100 m from `inside` and the exits counts as open ground.
std::vector<ExitSides> survey_exit_sides(const world::Scenario& scenario,
                                         const LoadedCrowd& loaded);

}  // namespace throng::scenarios
