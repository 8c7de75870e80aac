#include "places/scenarios/blueprint/generated.h"

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "places/scenarios/blueprint/blueprint.h"
#include "world/fields/read_scenario.h"

namespace throng::scenarios {

std::vector<Problem> problems_of_spec(std::vector<Problem> problems) {
  for (Problem& problem : problems) {
    problem.source.clear();
    problem.where = problem.where.starts_with("/people") ? "/people" : "";
  }
  return problems;
}

world::Scenario load_generated(const GeneratorSpec& spec) {
  const std::string id = generated_scenario_id(spec);
  try {
    BuiltScenario built = build_scenario(generate_blueprint(spec), id, id);
    world::Scenario scenario = world::parse_scenario(built.document, id, id);
    scenario.built_crowd = std::make_shared<const crowd::CrowdDescription>(std::move(built.crowd));
    return scenario;
  } catch (const InputError& error) {
    throw InputError(problems_of_spec(error.problems()));
  }
}

}  // namespace throng::scenarios
