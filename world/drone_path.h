// Flight paths of drones.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "world/trace.h"

namespace throng::world {

/// Flight path of a drone, from its first recorded position.
struct DronePath {
  std::string id;
  std::vector<Eigen::Vector3d> points;  ///< m, at least one

  /// Appends a point unless it is less than 10 cm from the last one.
  void add(const Eigen::Vector3d& point);
};

/// Returns the flight paths of all drones in a trace that have samples.
std::vector<DronePath> flown_paths(const Trace& trace);

}  // namespace throng::world
