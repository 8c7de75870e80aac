// Is a scenario closed but for its exits? Gaps by which people get out uncounted.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "world/scenario.h"
#include "world/scenarios/check/survey.h"

namespace throng::scenarios {

/// An opening in the outline of a scenario that is no exit.
struct Gap {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();  ///< m
  double width_m = 0;                                ///< between the walls on both sides
};

struct OutlineSurvey {
  /// By width, the widest first; empty where nobody gets out but by an exit.
  std::vector<Gap> gaps;
  /// Whether people can get out, but not through gaps: there are no walls that could be closed.
  bool is_open = false;
  Eigen::Vector2d open_at = Eigen::Vector2d::Zero();  ///< where they leave `inside`, if so
};

/// Looks for paths from the inner sides of the exits to the border of the ground around `inside`
/// that pass no exit. A closed exit is a wall only where the scene has an obstacle in it, as in a
/// run. Gaps are the shortest lines from wall to wall that close these paths without cutting
/// anybody off from the exits.
OutlineSurvey survey_outline(const world::Scenario& scenario, const LoadedCrowd& loaded,
                             const Routes& routes);

}  // namespace throng::scenarios
