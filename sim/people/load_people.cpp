#include "sim/people/load_people.h"

#include <utility>

#include "world/scenario_crowd.h"

namespace throng::sim {

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
  options.can_step = false;
  return {description.scene, description.behavior, options};
}

}  // namespace throng::sim
