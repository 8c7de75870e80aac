// Adds people to an imported scenario: reachable gates and positions at the start.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "places/imports/parts/imported_scenario.h"

namespace throng::imports {

/// Number of people, and the seed of their positions.
struct PopulateOptions {
  int people = 100;
  std::uint64_t seed = 1;
};

/// The gates and people of an imported scenario.
struct Population {
  std::vector<Gate> gates;              ///< each is reachable from every start
  std::vector<Eigen::Vector2d> starts;  ///< positions of people, m
};

/// Chooses the scenario's gates, or openings of its edge if there are none, and samples the
/// positions of people on ground that is connected with the gates, 0.9 m apart: first those of the
/// file, then random ones. Removes props in
/// buildings or in front of gates. Lists them, unreachable gates and missing room for people in
/// `scenario.skipped`. Throws InputError for a scenario that nobody can leave.
Population populate(ImportedScenario& scenario, const PopulateOptions& options);

/// Area (m²) of the ground from which populate() lets people leave; 0 if it would throw.
double open_ground_m2(const ImportedScenario& scenario);

/// The unit normal of a gate that points away from the center of the scenario.
Eigen::Vector2d outward_direction(const Gate& gate, const world::Rectangle& inside);

}  // namespace throng::imports
