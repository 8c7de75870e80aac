// A scenario and its crowd as they stand before the run begins: positions, walkable ground
// and distances to the exits. Input of checks and plans.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "crowd/crowd.h"
#include "crowd/navigation/walkable_grid.h"
#include "world/scenario.h"

namespace throng::scenarios {

/// The crowd's files read into memory, without the cost of a run.
struct LoadedCrowd {
  crowd::Crowd crowd;
  std::vector<std::uint8_t> is_person;  ///< per agent; the others stand for dangers
  std::vector<Problem> warnings;        ///< what was ignored while loading

  std::size_t count() const { return is_person.size(); }
  Eigen::Vector2d start(std::size_t agent) const {
    return crowd.agents.position[agent].cast<double>();
  }
};

/// Reads the scenario's Menge files. Throws InputError and EnvironmentError as crowd::Simulation.
LoadedCrowd load_scenario_crowd(const world::Scenario& scenario);

/// The ground inside of the scenario on which the slimmest of its people can stand, and the way
/// from there to the nearest open exit.
struct Routes {
  static constexpr int kNone = -1;

  crowd::WalkableGrid grid;       ///< of `inside`, the exits and a margin around them
  std::vector<int> nearest_exit;  ///< per cell: index into the scenario's exits, or kNone
  std::vector<float> distance_m;  ///< per cell: to that exit, by steps to one of eight cells
  std::vector<std::uint8_t> reached_from_exit;  ///< per exit: 0 where it is closed or walled up

  /// The cell of a point; kNone outside of the grid.
  int cell_at(const Eigen::Vector2d& point) const;
  /// The nearest walkable cell within `reach_m` of a point, or kNone.
  int walkable_near(const Eigen::Vector2d& point, double reach_m) const;
  Eigen::Vector2d cell_center(int cell) const;
};

Routes find_routes(const world::Scenario& scenario, const LoadedCrowd& loaded);

/// Whether somebody gets through a door: straight, from 1 m before it to 1 m behind it, somewhere
/// along its width.
bool is_passable(const world::Exit& exit, const Routes& routes);

}  // namespace throng::scenarios
