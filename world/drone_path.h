// Flight paths of drones.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "world/trace.h"

namespace throng::world {

/// A drone's flight path, from its start on.
struct DronePath {
  std::string id;
  std::vector<Eigen::Vector3d> points;  ///< m, at least one

  /// Adds a point; leaves out those that nobody would miss: less than 10 cm on.
  void add(const Eigen::Vector3d& point);
};

/// Flight paths of a run's drones.
std::vector<DronePath> flown_paths(const Trace& trace);

}  // namespace throng::world
