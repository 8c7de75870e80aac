// Scenarios from blueprints. A blueprint is a scenario file that describes its people ("people",
// "disasters") instead of naming Menge files. The crowd is made from it, so that the crowd's walls
// equal the rendered ones. docs/blueprint.md describes its fields.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "crowd/description/description.h"

namespace throng::scenarios {

/// Reads a blueprint. A blueprint that `extends` another file of its folder is merged into that
/// file (JSON merge patch, RFC 7396). Throws InputError and EnvironmentError.
nlohmann::json load_blueprint(const std::filesystem::path& file);

/// Whether the document of a file is a blueprint, by its fields or the file's suffix.
bool is_blueprint(const nlohmann::json& document, const std::filesystem::path& file);

/// A scenario in memory.
struct BuiltScenario {
  nlohmann::json document;  ///< content of the scenario's file without "crowd"
  crowd::CrowdDescription crowd;
};

/// Builds the scenario of a blueprint in memory. `source` names the blueprint in messages. Throws
/// InputError with all mistakes.
BuiltScenario build_scenario(const nlohmann::json& blueprint, const std::string& source,
                             const std::string& id);

/// The contents of the scenario's files ID.json, ID_scene.xml and ID_behavior.xml, by name. Equal
/// blueprints give equal bytes. Throws as build_scenario().
std::map<std::string, std::string> scenario_files(const nlohmann::json& blueprint,
                                                  const std::string& source, const std::string& id);

/// Writes the files of scenario_files() into the folder and returns the path of ID.json. Throws as
/// build_scenario(), and EnvironmentError if the folder cannot be written.
std::filesystem::path make_scenario(const nlohmann::json& blueprint, const std::string& source,
                                    const std::filesystem::path& folder, const std::string& id);
/// The same for the file of a blueprint. Messages name the file with the mistake, which may be the
/// file that the blueprint extends.
std::filesystem::path make_scenario(const std::filesystem::path& blueprint,
                                    const std::filesystem::path& folder, const std::string& id);

}  // namespace throng::scenarios
