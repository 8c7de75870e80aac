#include "jobs/spec/field_values.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "base/deprecation.h"
#include "base/error.h"
#include "jobs/spec/field_table.h"

namespace throng::jobs {

using nlohmann::json;
using nlohmann::ordered_json;

namespace {

constexpr double kMaxCoordinateM = 100'000;
constexpr const char* kIdentifier = "^[A-Za-z0-9_-]{1,32}$";

/// A number without a point where it is whole.
ordered_json plain(double number) {
  constexpr double kExact = 9'007'199'254'740'992;
  if (std::abs(number) <= kExact && number == std::trunc(number)) {
    return static_cast<std::int64_t>(number);
  }
  return number;
}

std::string quoted(std::span<const std::string> words) {
  std::vector<std::string> texts;
  for (const std::string& word : words) texts.push_back('"' + word + '"');
  return fmt::format("{}", fmt::join(texts, ", "));
}

Quantity word_quantity(const std::vector<std::string>& words) {
  return {"one of " + quoted(words),
          [words](const json& value) -> std::optional<double> {
            const auto found = std::find(words.begin(), words.end(), value);
            if (found == words.end()) return std::nullopt;
            return static_cast<double>(found - words.begin());
          },
          [words](double index) { return json(words.at(static_cast<std::size_t>(index))); },
          0,
          static_cast<double>(words.size()) - 1,
          false};
}

ordered_json rules_of(const FieldRules& field) {
  ordered_json rules = {{"title", field.title}, {"description", field.help}};
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
  ordered_json rules = {{"title", group.title},
                        {"description", group.help},
                        {"type", "object"},
                        {"additionalProperties", false}};
  if (!group.values.rules.is_null()) rules["required"] = group.values.rules;
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

Values integers(std::int64_t low, std::int64_t high) {
  Quantity quantity = number_quantity(static_cast<double>(low), static_cast<double>(high));
  quantity.expected = fmt::format("an integer from {} to {}", low, high);
  quantity.number = [number = quantity.number](const json& value) {
    return value.is_number_integer() ? number(value) : std::nullopt;
  };
  quantity.json = [](double value) { return json(std::llround(value)); };
  return {{{"type", "integer"}, {"minimum", low}, {"maximum", high}}, "", std::move(quantity)};
}

Values numbers(double low, double high) {
  return {{{"type", "number"}, {"minimum", plain(low)}, {"maximum", plain(high)}},
          "",
          number_quantity(low, high)};
}

Values numbers_above(double low, double high) {
  return {{{"type", "number"}, {"exclusiveMinimum", plain(low)}, {"maximum", plain(high)}}};
}

Values booleans() { return {{{"type", "boolean"}}}; }

Values texts(int min_length, int max_length) {
  return {{{"type", "string"}, {"minLength", min_length}, {"maxLength", max_length}}};
}

Values identifiers() { return texts_like(kIdentifier, "1 to 32 letters, digits, '_' or '-'"); }

Values texts_like(const std::string& pattern, const std::string& expected) {
  return {{{"type", "string"}, {"pattern", pattern}}, expected};
}

Values lists(int min_items, int max_items, ordered_json items) {
  return {{{"type", "array"},
           {"minItems", min_items},
           {"maxItems", max_items},
           {"items", std::move(items)}}};
}

Values coordinates(int count, bool is_random) {
  ordered_json items = numbers(-kMaxCoordinateM, kMaxCoordinateM).rules;
  if (is_random) items["x-randomize"] = true;
  return lists(count, count, std::move(items));
}

Values object_of(const ordered_json& fields) {
  ordered_json rules = {{"type", "object"}};
  rules.update(fields);
  return {std::move(rules)};
}

Values raw(ordered_json rules, std::string expected) {
  return {std::move(rules), std::move(expected)};
}

Values one_of(std::span<const std::string> words) {
  ordered_json list = ordered_json::array();
  for (const std::string& word : words) list.push_back(word);
  return {{{"type", "string"}, {"enum", std::move(list)}}};
}

Values sampled_words(std::span<const std::string> words) {
  return {{{"type", "string"}, {"pattern", fmt::format("^({})$", fmt::join(words, "|"))}},
          "",
          word_quantity({words.begin(), words.end()})};
}

ordered_json plain_numbers(const json& value) {
  if (value.is_number_float()) return plain(value.get<double>());
  return value;
}

json sampled_json(const Distribution& distribution, const Quantity& quantity) {
  return distribution.to_json(quantity);
}

json sampled_json(const std::optional<Distribution>& distribution, const Quantity& quantity) {
  return distribution ? distribution->to_json(quantity) : json();
}

const json* value_at(const json& object, std::string_view path) {
  const json* value = &object;
  while (true) {
    const std::size_t end = path.find('/');
    const auto found = value->find(path.substr(0, end));
    if (found == value->end()) return nullptr;
    value = &*found;
    if (end == std::string_view::npos) return value;
    path.remove_prefix(end + 1);
  }
}

std::string deprecated_path(const FieldRules& field) {
  return field.path.substr(0, field.path.rfind('/') + 1) + field.deprecated_name;
}

bool FieldPlace::allows_deprecated(const FieldRules& field, bool is_also_given) const {
  const std::string name = field.path.substr(field.path.rfind('/') + 1);
  if (is_also_given) {
    problems.push_back({"", pointer,
                        fmt::format("both \"{}\" and \"{}\"", name, field.deprecated_name),
                        fmt::format("only \"{}\"", name)});
    return false;
  }
  warn_deprecated(source, pointer, name);
  return true;
}

json::json_pointer pointer_below(const std::string& path) { return json::json_pointer("/" + path); }

ordered_json schema_of(std::span<const FieldRules* const> fields) {
  ordered_json schema = {{"additionalProperties", false}};
  ordered_json required = ordered_json::array();
  for (const FieldRules* field : fields) {
    if (field->is_required) required.push_back(field->path);
  }
  if (!required.empty()) schema["required"] = std::move(required);
  ordered_json& properties = schema["properties"] = ordered_json::object();
  for (const FieldRules* field : fields) {
    ordered_json* parent = &properties;
    std::string_view path = field->path;
    for (auto end = path.find('/'); end != std::string_view::npos; end = path.find('/')) {
      const std::string name(path.substr(0, end));
      check(parent->contains(name), "a group comes before its fields");
      parent = &(*parent)[name]["properties"];
      path.remove_prefix(end + 1);
    }
    (*parent)[std::string(path)] = field->is_group ? rules_of_group(*field) : rules_of(*field);
    if (field->deprecated_name.empty()) continue;
    check(!field->is_required && field->sampling == Sampling::never,
          "a renamed field is a plain one");
    ordered_json old = rules_of(*field);
    old["description"] = fmt::format("Deprecated: use {}.", path);
    old["deprecated"] = true;
    (*parent)[field->deprecated_name] = std::move(old);
  }
  return schema;
}

std::string schema_text(const ordered_json& schema) {
  std::string text;
  append_text(schema, "", 0, text);
  return text + "\n";
}

}  // namespace throng::jobs
