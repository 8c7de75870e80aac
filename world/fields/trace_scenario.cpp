#include "world/fields/trace_scenario.h"

#include <nlohmann/json.hpp>

#include "base/json/json_text.h"
#include "world/fields/read_scenario.h"

namespace throng::world {

std::optional<Scenario> scenario_in_trace(const TraceHeader& header, const std::string& source,
                                          TraceMeshes meshes) {
  if (header.scenario_document.empty()) return std::nullopt;
  nlohmann::json document = parse_json(header.scenario_document, source);
  if (document.is_object() && document.contains("meshes")) {
    if (meshes == TraceMeshes::needed && !document["meshes"].empty()) return std::nullopt;
    document.erase("meshes");
  }
  Scenario scenario = parse_scenario(document, source, header.scenario_id);
  scenario.alarm = header.alarm;
  return scenario;
}

}  // namespace throng::world
