// The schemas of scenarios and blueprints against their readers: what a reader refuses for its kind
// or its name, an editor marks, too.
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/files/files.h"
#include "base/files/resources.h"
#include "base/schemas/json_schema.h"
#include "places/scenarios/blueprint/blueprint.h"
#include "spec/blueprint/blueprint_fields.h"
#include "world/fields/read_scenario.h"
#include "world/fields/scenario_fields.h"
#include "world/scenario.h"
#include "world/semantic_class.h"

namespace throng::scenarios {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

enum class Kind { scenario, blueprint };

const fs::path kScenarios = source_folder() / "scenarios";

bool is_place(const fs::path& file) { return file.string().ends_with(".blueprint.json"); }

std::vector<fs::path> shipped(bool places) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(kScenarios)) {
    const std::string name = entry.path().filename();
    if (!name.ends_with(".json") || name.ends_with(".job.json") || name == "study.json") continue;
    if (is_place(entry.path()) == places) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

bool reads(Kind kind, const json& document, const fs::path& file) {
  try {
    if (kind == Kind::blueprint) {
      build_scenario(document, file, "it");
    } else {
      world::parse_scenario(document, file, "it");
    }
    return true;
  } catch (const InputError&) {
    return false;
  }
}

const schemas::JsonSchema& schema_for(Kind kind) {
  static const schemas::JsonSchema scenario(world::scenario_schema());
  static const schemas::JsonSchema blueprint(blueprint_schema());
  return kind == Kind::scenario ? scenario : blueprint;
}

bool is_valid(Kind kind, const json& document) {
  return schema_for(kind).problems(document, "").empty();
}

/// Places of all values but those deep in long lists, where one is as good as all.
void collect_pointers(const json& value, const json::json_pointer& at,
                      std::vector<json::json_pointer>& all) {
  if (!at.empty()) all.push_back(at);
  std::size_t seen = 0;
  for (const auto& [key, child] : value.items()) {
    if (value.is_array() && ++seen > 1) return;
    if (value.is_structured()) {
      collect_pointers(child, value.is_array() ? at / std::size_t{0} : at / key, all);
    }
  }
}

class ScenarioSchemas : public ::testing::TestWithParam<Kind> {};

TEST_P(ScenarioSchemas, HoldsForAllThatAreShipped) {
  const bool places = GetParam() == Kind::blueprint;
  const std::vector<fs::path> files = shipped(places);
  EXPECT_GE(files.size(), 8U);
  for (const fs::path& file : files) {
    const json whole = places ? load_blueprint(file) : json::parse(read_file(file));
    for (const Problem& problem : schema_for(GetParam()).problems(whole, file)) {
      ADD_FAILURE() << problem.text();
    }
    json named = whole;
    named["$schema"] = "../schemas/it.schema.json";
    if (named.contains("extends")) continue;
    EXPECT_TRUE(reads(GetParam(), named, file)) << file;
  }
}

TEST_P(ScenarioSchemas, RefusesTheSameDocumentsAsTheReader) {
  const bool places = GetParam() == Kind::blueprint;
  const fs::path file = kScenarios / "city_square" / "emergency.blueprint.json";
  const json blueprint = load_blueprint(file);
  const json whole = places ? blueprint : build_scenario(blueprint, file, "emergency").document;
  ASSERT_TRUE(reads(GetParam(), whole, file));
  std::vector<json::json_pointer> places_of_values;
  collect_pointers(whole, json::json_pointer(), places_of_values);
  ASSERT_GT(places_of_values.size(), 50U);
  const std::array<json, 4> others = {json("a word"), json(-1e9), json::object(), json(true)};
  for (const json::json_pointer& place : places_of_values) {
    for (const json& other : others) {
      json changed = whole;
      if (changed.at(place).type() == other.type()) continue;
      changed[place] = other;
      if (!reads(GetParam(), changed, file)) {
        EXPECT_FALSE(is_valid(GetParam(), changed)) << place << " = " << other;
      }
    }
    if (!whole.at(place).is_object()) continue;
    json more = whole;
    more[place]["colour_of_the_sky"] = 1;
    EXPECT_FALSE(is_valid(GetParam(), more)) << place;
    EXPECT_FALSE(reads(GetParam(), more, file)) << place;
  }
}

INSTANTIATE_TEST_SUITE_P(All, ScenarioSchemas, ::testing::Values(Kind::scenario, Kind::blueprint),
                         [](const auto& each) {
                           return each.param == Kind::scenario ? "scenario" : "blueprint";
                         });

// A mesh is an instance like a prop: its class is one of theirs.
TEST(SchemaOfMeshes, ListsTheClassesThatTheReaderKnows) {
  std::vector<std::string> classes;
  for (const world::SemanticClassInfo& known : world::semantic_classes()) {
    if (known.group == world::SemanticGroup::prop) classes.emplace_back(known.name);
  }
  for (const Kind kind : {Kind::scenario, Kind::blueprint}) {
    const json& schema = schema_for(kind).document();
    EXPECT_EQ(schema.at("/properties/meshes/items/properties/class/enum"_json_pointer),
              json(classes));
  }
}

}  // namespace
}  // namespace throng::scenarios
