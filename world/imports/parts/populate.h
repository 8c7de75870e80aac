// Gives a scenario people: gates that can be reached, and room to stand.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "world/imports/parts/imported_scenario.h"

namespace throng::imports {

struct PopulateOptions {
  int people = 100;
  std::uint64_t seed = 1;
};

/// The parts that a scenario lacks to be a scenario.
struct Population {
  std::vector<Gate> gates;              ///< each can be reached from every start
  std::vector<Eigen::Vector2d> starts;  ///< m
};

/// Takes the scenario's gates, or finds them where its edge is open, and draws where people stand:
/// everywhere that is connected with the gates, 0.9 m apart. Gates that cannot be reached, props
/// that stand in buildings or before gates, and people without room are noted in
/// `scenario.skipped`; such props are taken away. Throws InputError for a scenario that nobody can
/// leave.
Population populate(ImportedScenario& scenario, const PopulateOptions& options);

/// How much ground populate() would find from where people can leave: 0 where it would throw (m²).
double open_ground_m2(const ImportedScenario& scenario);

/// The direction out of a gate: a unit vector away from the middle of the scenario.
Eigen::Vector2d outward_direction(const Gate& gate, const world::Rectangle& inside);

}  // namespace throng::imports
