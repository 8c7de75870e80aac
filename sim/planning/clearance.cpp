#include "sim/planning/clearance.h"

#include <cmath>

#include "base/geometry/polygon.h"
#include "sim/planning/separation.h"

namespace throng::sim {

using Eigen::Vector3d;

double lowest_height_m(const Airframe& frame) {
  return 0.5 * frame.height_m + frame.propeller_radius_m;
}

const world::Building* building_near(const world::Scenario& scenario, const Vector3d& point,
                                     const Airframe& frame) {
  // The margin is for deviations from the path.
  const double room_m = frame.radius_m() + kFlightClearanceM;
  for (const world::Building& building : scenario.buildings) {
    if (point.z() < building.height_m + kFlightClearanceM &&
        geometry::distance_to(building.footprint, point.head<2>()) < room_m) {
      return &building;
    }
  }
  return nullptr;
}

const world::Building* building_between(const world::Scenario& scenario, const Vector3d& from,
                                        const Vector3d& to, const Airframe& frame) {
  constexpr double kProbeM = 0.25;  // less than the clearance
  // Without buildings nothing needs probing, at any length of the leg.
  if (scenario.buildings.empty()) return nullptr;
  const double probes = std::ceil((to - from).norm() / kProbeM);
  for (double i = 1; i < probes; ++i) {
    const world::Building* building =
        building_near(scenario, from + i / probes * (to - from), frame);
    if (building != nullptr) return building;
  }
  return nullptr;
}

}  // namespace throng::sim
