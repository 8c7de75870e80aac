// A scenario and its crowd before a run: positions, walkable ground and distances to the exits, as
// input of checks and plans.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "crowd/navigation/walkable_grid.h"
#include "crowd/state/crowd.h"
#include "world/scenario.h"

namespace throng::scenarios {

/// The crowd's files, read without preparing a simulation.
struct LoadedCrowd {
  crowd::Crowd crowd;
  std::vector<std::uint8_t> is_person;  ///< per agent; 0: represents a disaster
  std::vector<Problem> warnings;        ///< ignored parts of the files
  /// The first agent of each part of a blueprint's people, and the part's JSON pointer.
  std::vector<std::pair<std::size_t, std::string>> parts;

  /// The JSON pointer to what says where an agent starts.
  std::string part_of(std::size_t agent) const;
  std::size_t count() const { return is_person.size(); }
  Eigen::Vector2d start(std::size_t agent) const {
    return crowd.agents.position[agent].cast<double>();
  }
};

/// Reads the scenario's Menge files. Throws InputError and EnvironmentError as crowd::Simulation.
LoadedCrowd load_scenario_crowd(const world::Scenario& scenario);

/// A grid of the ground on which the person with the smallest radius can stand, with the paths to
/// the nearest open exits.
struct Routes {
  static constexpr int kNone = -1;

  crowd::WalkableGrid grid;       ///< covers `inside` and the exits with a margin
  std::vector<int> nearest_exit;  ///< per cell: index into the scenario's exits, or kNone
  std::vector<float> distance_m;  ///< per cell: path to that exit over eight-connected cells
  std::vector<std::uint8_t> reached_from_exit;  ///< per exit: 0 if it is closed or walled up

  /// The cell of a point; kNone outside of the grid.
  int cell_at(const Eigen::Vector2d& point) const;
  /// The nearest walkable cell within `reach_m` of a point, or kNone.
  int walkable_near(const Eigen::Vector2d& point, double reach_m) const;
  Eigen::Vector2d cell_center(int cell) const;
};

Routes find_routes(const world::Scenario& scenario, const LoadedCrowd& loaded);

/// The walkable cells of a rectangle with a margin, for the person with the smallest radius.
crowd::WalkableGrid walkable_ground(const world::Scenario& scenario, const LoadedCrowd& loaded,
                                    const world::Rectangle& around);

/// The bounding box of `inside` and the exits.
world::Rectangle bounds_with_exits(const world::Scenario& scenario);

/// Whether a person can pass a door: from some point of its width, free ground leads 1 m away from
/// it on both sides, straight or around obstacles.
bool is_passable(const world::Exit& exit, const Routes& routes);

}  // namespace throng::scenarios
