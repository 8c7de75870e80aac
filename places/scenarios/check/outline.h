// Detects gaps in the outline of a scenario through which people leave without passing an exit.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "places/scenarios/check/survey.h"
#include "world/scenario.h"

namespace throng::scenarios {

/// An opening in the outline of a scenario that is no exit.
struct Gap {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();  ///< m
  double width_m = 0;                                ///< between the walls on both sides
};

/// Result of survey_outline().
struct OutlineSurvey {
  /// Whether people leave by exits only.
  bool is_closed() const { return gaps.empty() && !is_open; }

  /// Gaps by width, the widest first; empty if people leave by exits only.
  std::vector<Gap> gaps;
  /// Whether people can leave where there are no walls between which a gap could be closed.
  bool is_open = false;
  Eigen::Vector2d open_at = Eigen::Vector2d::Zero();  ///< where they leave `inside` in that case, m
};

/// Searches for paths from the inner sides of the exits to the border of the ground around `inside`
/// that pass no exit. As in a run, a closed exit is a wall only if the scene has an obstacle there.
/// Gaps are the shortest lines from wall to wall that close these paths without cutting anybody off
/// from the exits.
OutlineSurvey survey_outline(const world::Scenario& scenario, const LoadedCrowd& loaded,
                             const Routes& routes);

}  // namespace throng::scenarios
