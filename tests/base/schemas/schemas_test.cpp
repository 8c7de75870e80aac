// The schemas of files.
#include "base/schemas/schemas.h"
#include "base/files/resources.h"

#include <gtest/gtest.h>

#include <functional>
#include <set>

#include "base/files/files.h"

namespace throng::schemas {
namespace {

using nlohmann::json;

/// Every part of a schema that describes a value, with its place.
void visit(const json& rules, const std::string& place,
           const std::function<void(const json&, const std::string&)>& see) {
  if (rules.is_array()) {
    for (const json& one : rules) visit(one, place, see);
    return;
  }
  if (!rules.is_object()) return;
  see(rules, place);
  for (const auto& [key, below] : rules.items()) {
    if (key == "properties" || key == "definitions") {
      for (const auto& [name, part] : below.items()) visit(part, place + "/" + name, see);
    } else if (key == "items" || key == "anyOf" || key == "additionalProperties") {
      visit(below, place + "/" + key, see);
    }
  }
}

TEST(Schemas, AreTheFilesOfTheFolder) {
  for (const Entry& entry : entries()) {
    const std::string file =
        source_folder().string() + "/base/schemas/" + std::string(entry.name) + ".schema.json";
    EXPECT_EQ(read_file(file), entry.text) << entry.name;
    EXPECT_EQ(schema_for(entry.kind).document()["title"], "throng " + std::string(entry.name));
  }
}

TEST(Schemas, EveryFieldIsDescribed) {
  for (const Entry& entry : entries()) {
    const json& schema = schema_for(entry.kind).document();
    visit(schema, "", [&](const json& rules, const std::string& place) {
      if (!rules.contains("properties")) return;
      for (const auto& [name, part] : rules["properties"].items()) {
        const json& field =
            part.contains("$ref")
                ? schema.at(json::json_pointer(part["$ref"].get<std::string>().substr(1)))
                : part;
        EXPECT_TRUE(field.contains("description")) << entry.name << ": " << place << "/" << name;
      }
    });
  }
}

TEST(Schemas, ReferencesAndRequiredFieldsExist) {
  for (const Entry& entry : entries()) {
    const json& schema = schema_for(entry.kind).document();
    std::set<std::string> used;
    visit(schema, "", [&](const json& rules, const std::string& place) {
      if (rules.contains("$ref")) {
        used.insert(rules["$ref"]);
        EXPECT_TRUE(schema.contains(json::json_pointer(rules["$ref"].get<std::string>().substr(1))))
            << entry.name << ": " << place;
      }
      if (!rules.contains("required") || !rules.contains("properties")) return;
      for (const json& name : rules["required"]) {
        EXPECT_TRUE(rules["properties"].contains(name)) << entry.name << ": " << place << name;
      }
    });
    const json definitions = schema.value("definitions", json::object());
    for (const auto& [name, part] : definitions.items()) {
      EXPECT_TRUE(used.contains("#/definitions/" + name))
          << entry.name << ": nothing uses " << name;
    }
  }
}

TEST(Schemas, RefuseFaultsThatTheReaderDidNotName) {
  std::vector<Problem> problems;
  add_schema_problems(Kind::camera, json::parse(R"({"width": 640, "height": "x", "lens": "pinhole",
                      "fx": 1, "fy": 1, "cx": 0, "cy": 0})"),
                      "camera.json", problems);
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].where, "/height");
  EXPECT_EQ(problems[0].source, "camera.json");
}

}  // namespace
}  // namespace throng::schemas
