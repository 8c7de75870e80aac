#include "sim/policies/lead_route.h"

#include <algorithm>

#include "base/geometry/polygon.h"

namespace throng::sim {

using Eigen::Vector2d;

LeadRoute route_through(const world::Exit& exit, const std::vector<world::Building>& buildings,
                        double before_m) {
  constexpr double kBeyondM = 2;
  constexpr double kDeepestM = 30;
  constexpr double kStepM = 0.5;
  const Vector2d middle = exit.middle();
  // The walls beside the exit path end where no building is about as near as the jambs are.
  double walls_end_m = 0;
  for (double depth_m = 0; depth_m <= kDeepestM; depth_m += kStepM) {
    const Vector2d point = middle + depth_m * exit.outward;
    const bool between_walls =
        std::any_of(buildings.begin(), buildings.end(), [&](const world::Building& building) {
          return geometry::distance_to(building.footprint, point) <= 0.6 * exit.length_m();
        });
    if (between_walls) walls_end_m = depth_m;
    if (depth_m > walls_end_m + kBeyondM) break;
  }
  return {
      {middle - before_m * exit.outward, middle, middle + (walls_end_m + kBeyondM) * exit.outward}};
}

std::vector<int> exits_to_lead_to(const world::Scenario& scenario,
                                  const std::vector<std::string>& ids) {
  std::vector<int> exits;
  for (std::size_t e = 0; e < scenario.exits.size(); ++e) {
    const bool named = ids.empty() || std::count(ids.begin(), ids.end(), scenario.exits[e].id) > 0;
    if (named && scenario.exits[e].open) exits.push_back(static_cast<int>(e));
  }
  return exits;
}

}  // namespace throng::sim
