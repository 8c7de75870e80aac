#include "spec/documents/published_schemas.h"

#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <string_view>

namespace throng::jobs {
namespace {

using nlohmann::json;

json parsed(std::string_view name) { return json::parse(published_schema(name)); }

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

TEST(PublishedSchemas, HaveTitles) {
  for (const std::string_view name : schema_names()) {
    EXPECT_NE(parsed(name).value("title", ""), "") << name;
  }
}

TEST(PublishedSchemas, EveryFieldIsDescribed) {
  for (const std::string_view kind : schema_names()) {
    const json schema = parsed(kind);
    visit(schema, "", [&](const json& rules, const std::string& place) {
      if (!rules.contains("properties")) return;
      for (const auto& [name, part] : rules["properties"].items()) {
        const json& field =
            part.contains("$ref")
                ? schema.at(json::json_pointer(part["$ref"].get<std::string>().substr(1)))
                : part;
        EXPECT_TRUE(field.contains("description")) << kind << ": " << place << "/" << name;
      }
    });
  }
}

TEST(PublishedSchemas, ReferencesAndRequiredFieldsExist) {
  for (const std::string_view kind : schema_names()) {
    const json schema = parsed(kind);
    std::set<std::string> used;
    visit(schema, "", [&](const json& rules, const std::string& place) {
      if (rules.contains("$ref")) {
        used.insert(rules["$ref"]);
        EXPECT_TRUE(schema.contains(json::json_pointer(rules["$ref"].get<std::string>().substr(1))))
            << kind << ": " << place;
      }
      if (!rules.contains("required") || !rules.contains("properties")) return;
      for (const json& name : rules["required"]) {
        EXPECT_TRUE(rules["properties"].contains(name)) << kind << ": " << place << name;
      }
    });
    const json definitions = schema.value("definitions", json::object());
    for (const auto& [name, part] : definitions.items()) {
      EXPECT_TRUE(used.contains("#/definitions/" + name)) << kind << ": nothing uses " << name;
    }
  }
}

}  // namespace
}  // namespace throng::jobs
