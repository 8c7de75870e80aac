#include "base/json/field_schema.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string_view>
#include <vector>

#include "base/error.h"

namespace throng::fields {

using nlohmann::ordered_json;

namespace {

ordered_json field_rules(const FieldRules& field) {
  ordered_json rules;
  if (!field.title.empty()) rules["title"] = field.title;
  rules["description"] = field.help;
  for (const auto& [key, value] : field.values.rules.items()) {
    // An object's own default precedes its fields.
    if (key == "properties" && !field.default_value.is_null()) {
      rules["default"] = field.default_value;
    }
    rules[key] = value;
  }
  const bool in_place = field.sampling == Sampling::in_place;
  if (in_place) rules["type"] = {field.values.rules.at("type"), "object"};
  const std::string expected = !field.values.expected.empty() ? field.values.expected
                               : in_place                     ? field.values.quantity->expected
                                                              : "";
  if (!expected.empty()) rules["x-expected"] = expected;
  if (in_place) {
    rules["x-distribution"] = {"choice"};
    if (field.values.quantity->continuous) {
      rules["x-distribution"] = {"choice", "uniform", "log_uniform", "normal"};
    }
  }
  if (field.sampling == Sampling::by_randomize) rules["x-randomize"] = true;
  if (!field.default_value.is_null()) rules["default"] = field.default_value;
  if (!field.unit.empty()) rules["unit"] = field.unit;
  return rules;
}

ordered_json rules_of_group(const FieldRules& group) {
  ordered_json rules;
  if (!group.title.empty()) rules["title"] = group.title;
  rules["description"] = group.help;
  rules["type"] = "object";
  rules["additionalProperties"] = false;
  if (!group.default_value.is_null()) rules["default"] = group.default_value;
  rules["properties"] = ordered_json::object();
  return rules;
}

void append_text(const ordered_json& value, const std::string& key, std::size_t indent,
                 std::string& text) {
  // Rules of items without a title are short.
  const bool is_short = key == "items" && !value.contains("title");
  if (!value.is_object() || value.empty() || is_short) {
    // Like dump(), with a space after commas and colons.
    if (value.is_array() || value.is_object()) {
      std::vector<std::string> parts;
      for (const auto& [name, part] : value.items()) {
        std::string inner;
        append_text(part, "items", indent, inner);
        parts.push_back(value.is_object() ? ordered_json(name).dump() + ": " + inner : inner);
      }
      text += fmt::format("{}{}{}", value.is_array() ? '[' : '{', fmt::join(parts, ", "),
                          value.is_array() ? ']' : '}');
    } else {
      text += value.dump();
    }
    return;
  }
  text += "{\n";
  std::size_t left = value.size();
  for (const auto& [name, part] : value.items()) {
    text += std::string(indent + 2, ' ') + ordered_json(name).dump() + ": ";
    append_text(part, name, indent + 2, text);
    text += --left > 0 ? ",\n" : "\n";
  }
  text += std::string(indent, ' ') + "}";
}

}  // namespace

ordered_json schema_for(std::span<const FieldRules* const> fields) {
  ordered_json schema = {{"additionalProperties", false}};
  ordered_json required = ordered_json::array();
  for (const FieldRules* field : fields) {
    if (!field->is_required || field->path.find('/') != std::string::npos) continue;
    if (field->deprecated_name.empty()) {
      required.push_back(field->path);
    } else {
      schema["anyOf"] = {{{"required", {field->path}}}, {{"required", {field->deprecated_name}}}};
    }
  }
  if (!required.empty()) schema["required"] = std::move(required);
  ordered_json& properties = schema["properties"] = ordered_json::object();
  for (const FieldRules* field : fields) {
    ordered_json* parent = &properties;
    ordered_json* group = nullptr;
    std::string_view path = field->path;
    for (auto end = path.find('/'); end != std::string_view::npos; end = path.find('/')) {
      const std::string name(path.substr(0, end));
      check(parent->contains(name), "a group comes before its fields");
      group = &(*parent)[name];
      parent = &(*group)["properties"];
      path.remove_prefix(end + 1);
    }
    (*parent)[std::string(path)] = field->is_group ? rules_of_group(*field) : field_rules(*field);
    if (!field->deprecated_name.empty()) {
      check(field->sampling == Sampling::never, "a renamed field is a plain one");
      ordered_json old = field_rules(*field);
      old["description"] = fmt::format("Deprecated: use {}.", path);
      old["deprecated"] = true;
      old["x-renamed-to"] = path;
      (*parent)[field->deprecated_name] = std::move(old);
    }
    // Last: a new member of the group moves the others, `parent` among them.
    if (group != nullptr && field->is_required) (*group)["required"].push_back(path);
  }
  return schema;
}

ordered_json document_schema(const std::string& title, const std::string& description,
                             const ordered_json& fields) {
  ordered_json schema = {{"$schema", "http://json-schema.org/draft-07/schema#"},
                         {"title", title},
                         {"description", description},
                         {"type", "object"}};
  schema.update(fields);
  return schema;
}

std::string schema_text(const ordered_json& schema) {
  std::string text;
  append_text(schema, "", 0, text);
  return text + "\n";
}

}  // namespace throng::fields
