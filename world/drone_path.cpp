#include "world/drone_path.h"

namespace throng::world {

void DronePath::add(const Eigen::Vector3d& point) {
  constexpr double kNobodyMissesM = 0.1;
  if (points.empty() || (point - points.back()).norm() >= kNobodyMissesM) points.push_back(point);
}

std::vector<DronePath> flown_paths(const Trace& trace) {
  std::vector<DronePath> paths;
  for (std::size_t i = 0; i < trace.drones.size(); ++i) {
    DronePath path{trace.header.drone_ids.at(i), {}};
    for (const DroneSample& sample : trace.drones[i]) path.add(sample.position);
    if (!path.points.empty()) paths.push_back(std::move(path));
  }
  return paths;
}

}  // namespace throng::world
