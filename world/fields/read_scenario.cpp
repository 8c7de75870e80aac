#include "world/fields/read_scenario.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "world/exits/exit_opening.h"
#include "world/extended_document.h"
#include "world/fields/scenario_fields.h"

namespace throng::world {

namespace fs = std::filesystem;

Scenario load_scenario(const fs::path& file, std::string id) {
  const ExtendedDocument document = read_extended(file, file.string());
  return read_with_files(document,
                         [&] { return parse_scenario(document.whole, file, std::move(id)); });
}

Scenario parse_scenario(const nlohmann::json& document, const fs::path& file, std::string id) {
  const std::string source = file.string();
  std::vector<Problem> problems;
  Scenario scenario;
  scenario.id = std::move(id);
  scenario_fields().read_checked(document, scenario, {"", source, problems});
  if (!problems.empty()) throw InputError(std::move(problems));
  for (const Disaster& disaster : scenario.disasters) {
    std::vector<int>& agents = scenario.disaster_agents;
    if (std::find(agents.begin(), agents.end(), disaster.agent) == agents.end()) {
      agents.push_back(disaster.agent);
    }
  }
  trim_to_openings(scenario.buildings, scenario.exits);
  nlohmann::json kept = document;
  for (const char* field : {"crowd", "$schema"}) kept.erase(field);
  scenario.document = kept.dump();
  return scenario;
}

}  // namespace throng::world
