// Where drones fly.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "world/trace.h"

namespace throng::world {

/// A drone's way through the air, from its start on.
struct DronePath {
  std::string id;
  std::vector<Eigen::Vector3d> places;  ///< m, at least one

  /// Adds a place; leaves out those that nobody would miss: less than 10 cm on.
  void add(const Eigen::Vector3d& place);
};

/// Where the drones of a run flew.
std::vector<DronePath> flown_paths(const Trace& trace);

}  // namespace throng::world
