#include "places/generated.h"

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "places/blueprint.h"

namespace throng::places {

world::Scenario load_generated(const PlaceSpec& spec) {
  const std::string id = scenario_id_of(spec);
  BuiltScenario built = build_scenario(generate_place(spec), id, id);
  world::Scenario scenario = world::parse_scenario(built.document, id, id);
  scenario.built_crowd = std::make_shared<const crowd::CrowdDescription>(std::move(built.crowd));
  return scenario;
}

}  // namespace throng::places
