#include "spec/scenarios/scenario_summary.h"

#include <fmt/core.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/error.h"
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
  json summary = {
      {"name", scenario.name},
      {"description", scenario.description},
      {"crowd_model", scenario.crowd_model.empty() ? json(nullptr) : json(scenario.crowd_model)},
      {"ground_m", {ground.min.x(), ground.min.y(), ground.max.x(), ground.max.y()}},
      {"exits", std::move(exits)},
      {"drones", std::move(drones)},
      {"buildings", scenario.buildings.size()},
      {"props", scenario.props.size()}};
  constexpr std::size_t kMaxBytes = 32 << 10;
  const std::size_t bytes = summary.dump(-1, ' ', false, json::error_handler_t::replace).size();
  if (bytes <= kMaxBytes) return summary;
  throw InputError(
      Problem{scenario.id, "",
              fmt::format("a name, a description, exits and drones of {} bytes together", bytes),
              fmt::format("at most {}: lists of scenarios hold them", kMaxBytes)});
}

}  // namespace throng::jobs
