#include "spec/scenarios/scenario_summary.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/geometry/angle.h"

namespace throng::jobs {

using nlohmann::json;

json scenario_summary(const world::Scenario& scenario) {
  json exits = json::array();
  for (const world::Exit& exit : scenario.exits) {
    exits.push_back({{"id", exit.id}, {"width_m", exit.width_m()}, {"open", exit.open}});
  }
  json drones = json::array();
  for (const world::DroneStart& drone : scenario.drones) {
    drones.push_back({{"id", drone.id},
                      {"start_m", {drone.position.x(), drone.position.y(), drone.position.z()}},
                      {"yaw_deg", std::round(drone.yaw_rad / kDegree * 1e6) / 1e6}});
  }
  const world::Rectangle& ground = scenario.ground;
  return {
      {"name", scenario.name},
      {"description", scenario.description},
      {"crowd_model", scenario.crowd_model.empty() ? json(nullptr) : json(scenario.crowd_model)},
      {"ground_m", {ground.min.x(), ground.min.y(), ground.max.x(), ground.max.y()}},
      {"exits", std::move(exits)},
      {"drones", std::move(drones)},
      {"buildings", scenario.buildings.size()},
      {"props", scenario.props.size()}};
}

}  // namespace throng::jobs
