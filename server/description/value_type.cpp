#include "server/description/value_type.h"

#include <charconv>

namespace throng::server {

using nlohmann::ordered_json;

namespace {

ordered_json nullable_schema(const ordered_json& schema) {
  const bool is_plain = schema.size() == 1 && schema.contains("type");
  if (is_plain && schema.at("type") != "object") return {{"type", {schema.at("type"), "null"}}};
  return {{"oneOf", {{{"type", "null"}}, schema}}};
}

ordered_json named_schema(std::string_view name) {
  if (name == "any") return ordered_json::object();
  if (name == "time") return {{"type", "string"}, {"format", "date-time"}};
  if (name == "binary") return {{"type", "string"}, {"format", "binary"}};
  const bool is_of_api = 'A' <= name.front() && name.front() <= 'Z';
  if (is_of_api) return {{"$ref", "#/components/schemas/" + std::string(name)}};
  return {{"type", name}};
}

ordered_json parsed(std::string_view text) {
  if (text.back() == '?') return nullable_schema(parsed(text.substr(0, text.size() - 1)));
  if (text.back() != ']') return named_schema(text);
  const std::size_t bracket = text.rfind('[');
  const ValueType items(parsed(text.substr(0, bracket)));
  std::size_t size = 0;
  std::from_chars(text.data() + bracket + 1, text.data() + text.size(), size);
  return (size == 0 ? list(items) : list(items, size, size)).schema();
}

ordered_json object_schema(const std::vector<Member>& members) {
  ordered_json required = ordered_json::array();
  ordered_json properties = ordered_json::object();
  for (const Member& member : members) {
    std::string name(member.name);
    if (name.ends_with('?')) {
      name.pop_back();
    } else {
      required.push_back(name);
    }
    ordered_json schema = member.type.schema();
    if (*member.help != '\0') schema["description"] = member.help;
    properties[name] = std::move(schema);
  }
  ordered_json schema = {{"type", "object"}};
  if (!required.empty()) schema["required"] = std::move(required);
  schema["properties"] = std::move(properties);
  return schema;
}

ValueType of_several(const char* keyword, const std::vector<ValueType>& types) {
  ordered_json schemas = ordered_json::array();
  for (const ValueType& type : types) schemas.push_back(type.schema());
  return ValueType(ordered_json{{keyword, std::move(schemas)}});
}

}  // namespace

ValueType::ValueType(const char* text) : schema_(parsed(text)) {}
ValueType::ValueType(const fields::Values& values) : schema_(values.rules) {}

ValueType object(const std::vector<Member>& members) { return ValueType(object_schema(members)); }

ValueType closed(const std::vector<Member>& members) {
  ordered_json schema = object_schema(members);
  schema["additionalProperties"] = false;
  return ValueType(std::move(schema));
}

ValueType map(const ValueType& values) {
  return ValueType(ordered_json{{"type", "object"}, {"additionalProperties", values.schema()}});
}

ValueType list(const ValueType& items) {
  return ValueType(ordered_json{{"type", "array"}, {"items", items.schema()}});
}

ValueType at_least_one(const ValueType& items) {
  ordered_json schema = list(items).schema();
  schema["minItems"] = 1;
  return ValueType(std::move(schema));
}

ValueType list(const ValueType& items, std::size_t min_items, std::size_t max_items) {
  ordered_json schema = list(items).schema();
  if (min_items > 0) schema["minItems"] = min_items;
  schema["maxItems"] = max_items;
  return ValueType(std::move(schema));
}

ValueType nullable(const ValueType& type) { return ValueType(nullable_schema(type.schema())); }
ValueType intersection(const std::vector<ValueType>& types) { return of_several("allOf", types); }
ValueType alternatives(const std::vector<ValueType>& types) { return of_several("oneOf", types); }
ValueType constant(const ordered_json& value) { return ValueType(ordered_json{{"const", value}}); }

ValueType text_up_to(std::size_t max_length) {
  return ValueType(ordered_json{{"type", "string"}, {"maxLength", max_length}});
}

ValueType at_least(std::int64_t min_number) {
  return ValueType(ordered_json{{"type", "integer"}, {"minimum", min_number}});
}

ValueType with_default(const ValueType& type, const ordered_json& usual) {
  ordered_json schema = type.schema();
  schema["default"] = usual;
  return ValueType(std::move(schema));
}

ValueType words(const std::vector<std::string_view>& words) {
  return ValueType(ordered_json{{"enum", words}});
}

}  // namespace throng::server
