#include "places/scenarios/blueprint/load_scenario.h"

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "places/scenarios/blueprint/blueprint.h"
#include "world/extended_document.h"
#include "world/fields/read_scenario.h"

namespace throng::scenarios {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

void close_exits(const std::vector<std::string>& closed, json& blueprint) {
  for (json& exit : blueprint["exits"]) {
    if (std::find(closed.begin(), closed.end(), exit["id"]) == closed.end()) continue;
    exit["open"] = false;
    for (const char* when : {"closes_at_s", "shuts_s"}) exit.erase(when);
  }
}

}  // namespace

world::Scenario load_scenario(const fs::path& file, std::string id,
                              const std::vector<std::string>& closed) {
  const std::string source = file.string();
  world::ExtendedDocument document = world::read_extended(file, source);
  return world::read_with_files(document, [&] {
    if (!is_blueprint(document.whole, file)) {
      return world::parse_scenario(document.whole, file, std::move(id));
    }
    if (!closed.empty()) close_exits(closed, document.whole);
    BuiltScenario built = build_scenario(document.whole, source, id);
    world::Scenario scenario = world::parse_scenario(built.document, file, std::move(id));
    scenario.built_crowd = std::make_shared<const crowd::CrowdDescription>(std::move(built.crowd));
    return scenario;
  });
}

world::Scenario find_scenario(const fs::path& folder, const std::string& id,
                              const std::vector<std::string>& closed) {
  return load_scenario(world::scenario_file(folder, id), id, closed);
}

}  // namespace throng::scenarios
