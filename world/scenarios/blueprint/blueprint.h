// A scenario from one file. A blueprint is a scenario file that says who is there in plain words
// ("people", "disasters") instead of naming Menge files; these are made from it, so that the walls
// that the crowd minds are those that are drawn. docs/blueprint.md describes its fields.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "crowd/description/description.h"

namespace throng::scenarios {

/// Reads a blueprint; one that `extends` another file of its folder says only what differs
/// (RFC 7396). Throws InputError and EnvironmentError.
nlohmann::json load_blueprint(const std::filesystem::path& file);

/// Whether the document of a file is a blueprint: by its fields, or by the file's ending.
bool is_blueprint(const nlohmann::json& document, const std::filesystem::path& file);

/// A scenario in memory.
struct BuiltScenario {
  nlohmann::json document;  ///< what is in the scenario's file, but for its "crowd"
  crowd::CrowdDescription crowd;
};

/// Builds the scenario that a blueprint describes. `source` names the blueprint in messages. Throws
/// InputError for what is wrong with it.
BuiltScenario build_scenario(const nlohmann::json& blueprint, const std::string& source,
                             const std::string& id);

/// The scenario's files ID.json, ID_scene.xml and ID_behavior.xml by their names. The same
/// blueprint gives the same bytes. Throws like build_scenario.
std::map<std::string, std::string> scenario_files(const nlohmann::json& blueprint,
                                                  const std::string& source, const std::string& id);

/// Makes the scenario ID.json, ID_scene.xml and ID_behavior.xml in the folder and returns the
/// first. Throws like build_scenario, and EnvironmentError when the folder cannot be written.
std::filesystem::path make_scenario(const nlohmann::json& blueprint, const std::string& source,
                                    const std::filesystem::path& folder, const std::string& id);
/// The same of a blueprint's file; messages name the file that a fault is in, which may be the one
/// that the blueprint extends.
std::filesystem::path make_scenario(const std::filesystem::path& blueprint,
                                    const std::filesystem::path& folder, const std::string& id);

}  // namespace throng::scenarios
