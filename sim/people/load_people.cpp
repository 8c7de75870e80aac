#include "sim/people/load_people.h"

#include <utility>
#include <vector>

#include "spec/skinning/styling.h"
#include "world/scenario_crowd.h"

namespace throng::sim {

namespace {

// A body that is longer than a disc, as one: about the area of a person with a pram (0.6 m wide and
// 1.05 m long) or a case; narrow enough for doors. Estimated, as is the speed.
constexpr float kLeaderRadiusM = 0.4F;
constexpr float kLeaderSpeed = 0.9F;  // share of that without

std::vector<crowd::MeteredDoor> metered_doors(const world::Scenario& scenario) {
  std::vector<crowd::MeteredDoor> doors;
  for (const world::Exit& exit : scenario.exits) {
    if (!exit.capacity) continue;
    const auto per_s = static_cast<float>(exit.capacity->per_s_at(exit.width_m()));
    doors.push_back(
        {exit.from.cast<float>(), exit.to.cast<float>(), exit.outward.cast<float>(), per_s, false});
  }
  for (const world::InnerDoor& door : scenario.doors) {
    const Eigen::Vector2d along = door.to - door.from;
    const auto per_s = static_cast<float>(door.capacity.per_s_at(along.norm()));
    doors.push_back({door.from.cast<float>(), door.to.cast<float>(),
                     Eigen::Vector2d(-along.y(), along.x()).normalized().cast<float>(), per_s,
                     true});
  }
  return doors;
}

}  // namespace

std::string model_for(const world::Scenario& scenario, const CrowdSpec& spec) {
  if (!spec.model.empty()) return spec.model;
  if (!scenario.crowd_model.empty()) return scenario.crowd_model;
  return spec.compat == crowd::Compat::none ? "ttc" : "orca";
}

crowd::Simulation load_people(const world::Scenario& scenario, std::uint64_t seed,
                              const CrowdSpec& spec) {
  const crowd::CrowdDescription description = world::build_crowd(scenario);
  crowd::LoadOptions options;
  options.seed = seed;
  options.model = model_for(scenario, spec);
  options.compat = spec.compat;
  options.separation = spec.separation;
  options.constants = spec.constants;
  options.compliance = spec.compliance;
  options.physical = spec.physical;
  options.metered_doors = metered_doors(scenario);
  options.can_step = false;
  crowd::Simulation people(description.scene, description.behavior, options);
  for (std::size_t agent = 0; agent < people.agent_count(); ++agent) {
    if (!skinning::is_leading(seed, static_cast<std::uint32_t>(agent), spec.leading)) continue;
    people.burden(agent, kLeaderRadiusM, kLeaderSpeed);
  }
  return people;
}

}  // namespace throng::sim
