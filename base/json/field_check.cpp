#include "base/json/field_check.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <string_view>

#include "base/json/deprecation.h"
#include "base/json/json_describe.h"
#include "base/json/json_integer.h"
#include "base/text/control_characters.h"
#include "base/text/suggest.h"
#include "base/text/utf8.h"

namespace throng::fields {

using nlohmann::json;
using nlohmann::ordered_json;

namespace {

// Numbers as a person writes them: 60, not 60.0.
std::string number_text(const json& value) {
  return value.is_number_float() ? fmt::format("{}", value.get<double>()) : value.dump();
}

std::string range_text(const json& schema) {
  const auto limit = [&](const char* name) { return number_text(schema[name]); };
  const bool ends = schema.contains("maximum");
  if (schema.contains("exclusiveMinimum")) {
    return " above " + limit("exclusiveMinimum") + (ends ? " and at most " + limit("maximum") : "");
  }
  if (!schema.contains("minimum")) return "";
  return ends ? fmt::format(" from {} to {}", limit("minimum"), limit("maximum"))
              : " of at least " + limit("minimum");
}

bool is_one_line(const json& schema) { return schema.value(kOneLine, false); }

std::string array_text(const json& schema) {
  const auto min_items = schema.value("minItems", 0);
  const auto max_items = schema.value("maxItems", 0);
  return fmt::format("an array of {}{}",
                     schema.value("uniqueItems", false) ? "different items, " : "",
                     min_items == max_items ? fmt::format("{} items", max_items)
                                            : fmt::format("{} to {} items", min_items, max_items));
}

}  // namespace

std::string expectation(const json& schema) {
  if (schema.contains("x-expected")) return schema["x-expected"];
  if (schema.contains("enum")) {
    std::vector<std::string> words;
    for (const json& word : schema["enum"]) words.push_back(word.dump());
    return (words.size() > 1 ? "one of " : "") + fmt::format("{}", fmt::join(words, ", "));
  }
  const json& types = schema.at("type");
  const std::string type = types.is_array() ? types.front() : types;
  if (type == "object") return "an object";
  if (type == "array") return array_text(schema);
  if (type == "integer") return "an integer" + range_text(schema);
  if (type == "number") return "a number" + range_text(schema);
  if (type == "boolean") return "true or false";
  const std::string text =
      schema.contains("maxLength")
          ? fmt::format("a text of {} to {} characters", schema.value("minLength", 0),
                        schema["maxLength"].get<int>())
          : "a text";
  return text + (is_one_line(schema) ? " without control characters" : "");
}

namespace {

std::string describe_expected(const FieldRules& field) {
  if (!field.values.expected.empty()) return field.values.expected;
  return field.is_group ? "an object" : expectation(field.values.rules);
}

bool is_of_type(const json& value, std::string_view type) {
  if (type == "integer") return is_integer(value);
  if (type == "number") return value.is_number();
  if (type == "boolean") return value.is_boolean();
  if (type == "string") return value.is_string();
  if (type == "array") return value.is_array();
  if (type == "null") return value.is_null();
  return value.is_object();
}

bool keeps_type(const json& value, const ordered_json& type) {
  if (type.is_string()) return is_of_type(value, type.get<std::string>());
  return std::any_of(type.begin(), type.end(), [&](const ordered_json& one) {
    return is_of_type(value, one.get<std::string>());
  });
}

bool keeps_range(const json& value, const ordered_json& rules) {
  const auto limit = [&](const char* name, auto keeps) {
    return !rules.contains(name) || keeps(rules[name].get<double>());
  };
  if (value.is_number()) {
    const auto number = value.get<double>();
    return limit("minimum", [&](double low) { return number >= low; }) &&
           limit("exclusiveMinimum", [&](double low) { return number > low; }) &&
           limit("maximum", [&](double high) { return number <= high; });
  }
  const bool is_text = value.is_string();
  if (!is_text && !value.is_array()) return true;
  if (is_text && is_one_line(rules) &&
      has_control_characters(value.get_ref<const std::string&>())) {
    return false;
  }
  const auto size = static_cast<double>(
      is_text ? character_count(value.get_ref<const std::string&>()) : value.size());
  return limit(is_text ? "minLength" : "minItems", [&](double low) { return size >= low; }) &&
         limit(is_text ? "maxLength" : "maxItems", [&](double high) { return size <= high; });
}

bool keeps_words(const json& value, const ordered_json& rules) {
  const auto words = rules.find("enum");
  return words == rules.end() ||
         std::any_of(words->begin(), words->end(), [&](const json& word) { return word == value; });
}

bool keeps_rules(const json& value, const ordered_json& rules) {
  return keeps_type(value, rules.at("type")) && keeps_words(value, rules) &&
         keeps_range(value, rules);
}

/// Checks the elements of a list; those with fields of their own are read by a table.
bool check_elements(const json& list, const ordered_json& rules, const FieldLocation& place) {
  const auto items = rules.find("items");
  if (items == rules.end() || !items->contains("type") || items->contains("properties")) {
    return true;
  }
  bool is_valid = true;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const FieldLocation element = place.below(i);
    if (!keeps_rules(list[i], *items)) {
      element.reject(describe(list[i]), expectation(*items));
      is_valid = false;
    } else if (list[i].is_array()) {
      is_valid = check_elements(list[i], *items, element) && is_valid;
    }
  }
  return is_valid;
}

/// The part of a path after its last '/'.
std::string name_in(const std::string& path) { return path.substr(path.rfind('/') + 1); }

/// Checks the names in an object of the table: that of the group at `path`, "" for the whole.
void check_names(const json& object, const std::string& path,
                 std::span<const FieldRules* const> fields, const FieldLocation& place) {
  std::vector<std::string> known;
  std::vector<std::string> deprecated;
  for (const FieldRules* field : fields) {
    const std::size_t end = field->path.rfind('/');
    if ((end == std::string::npos ? "" : field->path.substr(0, end)) != path) continue;
    known.push_back(name_in(field->path));
    if (!field->deprecated_name.empty()) deprecated.push_back(field->deprecated_name);
    const bool is_given =
        object.contains(known.back()) ||
        (!field->deprecated_name.empty() && object.contains(field->deprecated_name));
    if (!field->is_required || is_given) continue;
    place.problems.push_back(
        {place.source, place.below(field->path).pointer, "nothing", describe_expected(*field)});
  }
  std::vector<std::string_view> names;
  std::copy_if(known.begin(), known.end(), std::back_inserter(names),
               [](const std::string& name) { return !name.starts_with('$'); });
  for (const auto& [name, value] : object.items()) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    if (std::find(deprecated.begin(), deprecated.end(), name) != deprecated.end()) continue;
    const std::string key = (json::json_pointer() / name).to_string().substr(1);
    const std::string below = path.empty() ? key : path + "/" + key;
    place.problems.push_back(
        unknown_name(place.source, place.below(below).pointer, "field", name, names));
  }
}

}  // namespace

std::string deprecated_path(const FieldRules& field) {
  return field.path.substr(0, field.path.rfind('/') + 1) + field.deprecated_name;
}

bool FieldLocation::allows_deprecated(const FieldRules& field, bool is_also_given) const {
  const std::string name = field.path.substr(field.path.rfind('/') + 1);
  if (is_also_given) {
    problems.push_back({source, pointer,
                        fmt::format("both \"{}\" and \"{}\"", name, field.deprecated_name),
                        fmt::format("only \"{}\"", name)});
    return false;
  }
  warn_deprecated(source, pointer, name);
  return true;
}

void FieldLocation::reject(std::string found, std::string expected) const {
  problems.push_back({source, pointer, std::move(found), std::move(expected)});
}

bool FieldLocation::has_problem(std::string_view path) const {
  const std::string whole = path.empty() ? pointer : fmt::format("{}/{}", pointer, path);
  return std::any_of(problems.begin(), problems.end(), [&](const Problem& problem) {
    return problem.where == whole || problem.where.starts_with(whole + "/");
  });
}

bool check_value(const json& value, const Values& values, const FieldLocation& place) {
  const ordered_json& rules = values.rules;
  if (!keeps_rules(value, rules) ||
      (values.has_pattern && !values.has_pattern(value.get_ref<const std::string&>()))) {
    place.reject(describe(value), values.expected.empty() ? expectation(rules) : values.expected);
    return false;
  }
  return !value.is_array() || check_elements(value, rules, place);
}

bool check_object(const json& value, std::span<const FieldRules* const> fields,
                  const FieldLocation& place) {
  if (!value.is_object()) {
    place.problems.push_back({place.source, place.pointer, describe(value), "an object"});
    return false;
  }
  check_names(value, "", fields, place);
  for (const FieldRules* group : fields) {
    const json* found = group->is_group ? value_at(value, group->path) : nullptr;
    if (found == nullptr) continue;
    if (found->is_object()) {
      check_names(*found, group->path, fields, place);
    } else {
      place.problems.push_back({place.source, place.below(group->path).pointer, describe(*found),
                                describe_expected(*group)});
    }
  }
  return true;
}

}  // namespace throng::fields
