#include "places/scenarios/blueprint/blueprint.h"

#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "base/files/files.h"
#include "base/schemas/json_schema.h"
#include "crowd/description/menge_files/write.h"
#include "places/scenarios/blueprint/blocked.h"
#include "places/scenarios/blueprint/crowd_behavior.h"
#include "places/scenarios/blueprint/crowd_scene.h"
#include "places/scenarios/blueprint/leaving_stands.h"
#include "places/scenarios/blueprint/people.h"
#include "places/scenarios/blueprint/shorthand.h"
#include "spec/blueprint/blueprint_fields.h"
#include "world/extended_document.h"
#include "world/fields/read_scenario.h"
#include "world/scenario.h"

namespace throng::scenarios {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

std::string file_name(const std::string& id) { return id + ".json"; }
std::string scene_name(const std::string& id) { return id + "_scene.xml"; }
std::string behavior_name(const std::string& id) { return id + "_behavior.xml"; }

json disasters_json(const People& people) {
  json list = json::array();
  for (const Danger& danger : people.dangers) {
    const world::Disaster& seen = danger.seen;
    list.push_back({{"kind", world::kDisasterKinds.at(static_cast<std::size_t>(seen.kind))},
                    {"agent", seen.agent},
                    {"position", {seen.position.x(), seen.position.y()}},
                    {"start_s", seen.start_s},
                    {"radius_m", seen.radius_m},
                    {"growth_mps", seen.growth_mps},
                    {"max_radius_m", seen.max_radius_m}});
  }
  return list;
}

/// The scenario file's document without what only the people say, and without its crowd.
json scenario_json(const json& blueprint) {
  json document = blueprint;
  document.erase("people");
  document.erase("disasters");
  document.erase("$schema");
  const auto exits = document.find("exits");
  if (exits == document.end() || !exits->is_array()) return document;
  int number = 0;
  for (json& exit : *exits) {
    if (exit.is_object()) exit["goals"] = json::array({{kLeavingSet, number}});
    ++number;
  }
  return document;
}

/// The scenario without its people: what is wrong with it is the blueprint's fault.
world::Scenario scenario_without_people(json document, const std::string& source,
                                        const std::string& id) {
  document.erase("meshes");   // their files are not here, and people do not walk into them
  document.erase("clutter");  // nor do they walk where it lies
  return world::parse_scenario(document, source, id);
}

/// A disaster's changes to the exits, and the goals of fleeing people.
void add_emergency(const world::Scenario& scenario, const People& people, json& document) {
  if (people.dangers.empty()) return;
  document["disasters"] = disasters_json(people);
  const std::vector<BlockedDisc> discs = blocked_discs(people);
  for (std::size_t i = 0; i < scenario.exits.size(); ++i) {
    const world::Exit& exit = scenario.exits[i];
    const BlockedDisc* const disc = first_to_reach(exit, discs);
    json& written = document["exits"][i];
    if (!anybody_leaves(people)) written["goals"].clear();
    if (can_flee_by(disc)) written["goals"].push_back({kFleeingSet, i});
    if (written["goals"].empty()) written.erase("goals");
    if (disc == nullptr || !exit.is_open(disc->from_s)) continue;
    if (disc->from_s > 0) {
      written["closes_at_s"] = disc->from_s;
    } else {
      written["open"] = false;
    }
  }
  for (std::size_t i = 0; i < scenario.drones.size(); ++i) {
    document["drones"][i]["moves_goal"] = {kGuidesSet, i};
  }
}

}  // namespace

json load_blueprint(const fs::path& file) {
  return world::read_extended(file, file.string()).whole;
}

bool is_blueprint(const json& document, const fs::path& file) {
  if (!document.is_object()) return false;
  const bool has_people = document.contains("people");
  const bool has_name = world::is_blueprint_name(file.string());
  return document.contains("crowd") ? has_people && has_name : has_people || has_name;
}

namespace {

/// Adds problems for unknown and missing fields of a blueprint without shorthand.
void check_names(const json& blueprint, const fields::FieldLocation& place) {
  static const std::vector<fields::FieldRules> rules = blueprint_rules();
  std::vector<const fields::FieldRules*> all;
  all.reserve(rules.size());
  for (const fields::FieldRules& field : rules) all.push_back(&field);
  fields::check_object(blueprint, all, place);
}

/// For rules that concern fields beside those of the scenario without people.
const schemas::JsonSchema& compiled_schema() {
  static const schemas::JsonSchema schema(blueprint_schema());
  return schema;
}

BuiltScenario build_from(const json& blueprint, const json& said, const std::string& source,
                         const std::string& id) {
  std::vector<Problem> problems;
  const fields::FieldLocation place{"", source, problems};
  check_names(blueprint, place);
  if (!problems.empty()) throw InputError(std::move(problems));
  BuiltScenario built{scenario_json(blueprint), {}};
  const world::Scenario scenario = scenario_without_people(built.document, source, id);
  People people = read_people(blueprint, scenario, place);
  schemas::add_other_places(problems, compiled_schema().problems(said, source));
  if (!problems.empty()) throw InputError(std::move(problems));
  add_leaving_spectators(scenario, place, people);
  if (!problems.empty()) throw InputError(std::move(problems));
  built.crowd = crowd_of_people(scenario, people, problems);
  for (Problem& problem : problems) problem.source = source;
  if (!problems.empty()) throw InputError(std::move(problems));
  add_emergency(scenario, people, built.document);
  return built;
}

}  // namespace

BuiltScenario build_scenario(const json& said, const std::string& source, const std::string& id) {
  const Expanded expanded = expand_shorthand(said, source);
  try {
    return build_from(expanded.blueprint, said, source, id);
  } catch (const InputError& error) {
    throw InputError(expanded.as_said(error.problems(), said));
  }
}

std::map<std::string, std::string> scenario_files(const json& blueprint, const std::string& source,
                                                  const std::string& id) {
  BuiltScenario built = build_scenario(blueprint, source, id);
  built.document["crowd"] = {{"scene", scene_name(id)}, {"behavior", behavior_name(id)}};
  return {{scene_name(id), crowd::to_xml(built.crowd.scene)},
          {behavior_name(id), crowd::to_xml(built.crowd.behavior)},
          {file_name(id), built.document.dump(1) + "\n"}};
}

fs::path make_scenario(const json& blueprint, const std::string& source, const fs::path& folder,
                       const std::string& id) {
  for (const auto& [name, text] : scenario_files(blueprint, source, id)) {
    write_file_atomically(folder / name, text);
  }
  return folder / file_name(id);
}

fs::path make_scenario(const fs::path& blueprint, const fs::path& folder, const std::string& id) {
  const std::string source = blueprint.string();
  const world::ExtendedDocument document = world::read_extended(blueprint, source);
  return world::read_with_files(document,
                                [&] { return make_scenario(document.whole, source, folder, id); });
}

}  // namespace throng::scenarios
