// A scenario from one file. A blueprint is a scenario file that says who is there in plain words
// ("people", "disasters") instead of naming Menge files; these are made from it, so that the walls
// that the crowd minds are those that are drawn. docs/blueprint.md describes its fields.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace throng::places {

/// Reads a blueprint; one that `extends` another file of its folder says only what differs
/// (RFC 7396). Throws InputError and EnvironmentError.
nlohmann::json load_blueprint(const std::filesystem::path& file);

/// Makes the scenario ID.json, ID_scene.xml and ID_behavior.xml in the folder and returns the
/// first. `source` names the blueprint in messages. The same blueprint gives the same bytes. Throws
/// InputError for what is wrong with it, EnvironmentError when the folder cannot be written.
std::filesystem::path make_scenario(const nlohmann::json& blueprint, const std::string& source,
                                    const std::filesystem::path& folder, const std::string& id);

}  // namespace throng::places
