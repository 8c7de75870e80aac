#include "base/schemas/json_schema.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <string_view>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "base/json/field_table.h"
#include "base/json/json_describe.h"
#include "base/json/json_integer.h"
#include "base/text/control_characters.h"
#include "base/text/suggest.h"

namespace throng::schemas {

using nlohmann::json;

namespace {

/// valijson names a place ["<root>", "[drones]", "[0]"].
using Context = std::vector<std::string>;

std::string strip_brackets(const std::string& step) { return step.substr(1, step.size() - 2); }

json::json_pointer pointer_to(const Context& context) {
  json::json_pointer pointer;
  for (std::size_t i = 1; i < context.size(); ++i) pointer /= strip_brackets(context[i]);
  return pointer;
}

/// Finds the part of a schema that describes a place.
class Rules {
 public:
  explicit Rules(const json& schema) : schema_(schema) {}

  const json& at(const Context& context) const {
    const json* rules = &resolved(schema_);
    for (std::size_t i = 1; i < context.size(); ++i) {
      const json* below = child(*rules, strip_brackets(context[i]));
      if (below == nullptr) break;
      rules = below;
    }
    return *rules;
  }

  const json& resolved(const json& rules) const {
    const auto reference = rules.find("$ref");
    if (reference == rules.end()) return rules;
    return resolved(schema_.at(json::json_pointer(reference->get<std::string>().substr(1))));
  }

  /// The rules of a member or an element; null where the schema says nothing of it.
  const json* child(const json& rules, const std::string& key) const {
    if (const auto items = rules.find("items"); items != rules.end()) return &resolved(*items);
    if (const auto found = rules.find("properties"); found != rules.end() && found->contains(key)) {
      return &resolved((*found)[key]);
    }
    if (const auto more = rules.find("additionalProperties");
        more != rules.end() && more->is_object()) {
      return &resolved(*more);
    }
    for (const char* alternatives : {"anyOf", "oneOf", "allOf"}) {
      const auto found = rules.find(alternatives);
      if (found == rules.end()) continue;
      for (const json& one : *found) {
        if (const json* below = child(resolved(one), key)) return below;
      }
    }
    return nullptr;
  }

 private:
  const json& schema_;
};

std::string expected_at(const json& rules) {
  const bool says =
      rules.contains("x-expected") || rules.contains("enum") || rules.contains("type");
  return says ? fields::expectation(rules) : "what the schema describes";
}

/// A value that the rules do not allow: a misspelled word with the nearest of those that they list.
Problem problem_of_value(const json& value, const json& rules, const std::string& where,
                         const std::string& source) {
  if (value.is_string() && rules.contains("enum") && !rules.contains("x-expected")) {
    std::vector<std::string_view> words;
    for (const json& word : rules["enum"]) {
      if (word.is_string()) words.emplace_back(word.get_ref<const std::string&>());
    }
    const auto& word = value.get_ref<const std::string&>();
    if (closest(word, words)) return unknown_name(source, where, "value", word, words);
  }
  return {source, where, describe(value), expected_at(rules)};
}

void add_field_problems(const json& object, const json& rules, const Rules& all,
                        const json::json_pointer& place, const std::string& source,
                        std::vector<Problem>& problems) {
  const json& properties = rules["properties"];
  if (rules.value("additionalProperties", json(true)) == false) {
    std::vector<std::string_view> known;
    for (const auto& field : properties.items()) {
      if (!field.value().value("deprecated", false)) known.emplace_back(field.key());
    }
    for (const auto& field : object.items()) {
      if (properties.contains(field.key())) continue;
      problems.push_back(
          unknown_name(source, (place / field.key()).to_string(), "field", field.key(), known));
    }
  }
  for (const json& field : rules.value("required", json::array())) {
    const auto& name = field.get_ref<const std::string&>();
    if (object.contains(name)) continue;
    problems.push_back({source, (place / name).to_string(), "nothing",
                        expected_at(all.resolved(properties[name]))});
  }
}

/// Adds texts of one line (kOneLine) that have control characters, at and below a value.
void add_control_characters(const json& value, const json& rules, const Rules& all,
                            const json::json_pointer& place, const std::string& source,
                            std::vector<Problem>& problems) {
  if (value.is_string() && rules.value(kOneLine, false) &&
      has_control_characters(value.get_ref<const std::string&>())) {
    problems.push_back({source, place.to_string(), describe(value), expected_at(rules)});
  }
  if (!value.is_structured()) return;
  for (const auto& [key, member] : value.items()) {
    const json* below = all.child(rules, key);
    if (below == nullptr || !below->is_object()) continue;
    const json::json_pointer pointer = value.is_array() ? place / std::stoul(key) : place / key;
    add_control_characters(member, *below, all, pointer, source, problems);
  }
}

/// valijson reports a bad value again at every object and array around it: which places are those
/// that nothing bad lies in.
std::map<Context, bool> innermost_places(const valijson::ValidationResults& results) {
  std::map<Context, bool> is_innermost;
  for (const auto& error : results) is_innermost[error.context] = true;
  for (auto& [context, innermost] : is_innermost) {
    const auto next = is_innermost.upper_bound(context);
    innermost = next == is_innermost.end() || next->first.size() <= context.size() ||
                !std::equal(context.begin(), context.end(), next->first.begin());
  }
  return is_innermost;
}

/// Whether `pointer` is `other` or below it.
bool is_at_or_below(const std::string& pointer, const std::string& other) {
  return pointer == other || other.empty() || other == "/" || pointer.starts_with(other + "/");
}

/// valijson takes the kind of a number for its type: 2.0 becomes the integer that it is.
void use_integers(json& value) {
  if (value.is_structured()) {
    for (json& element : value) use_integers(element);
  } else if (value.is_number_float() && is_integer(value)) {
    value = static_cast<std::int64_t>(value.get<double>());
  }
}

}  // namespace

struct JsonSchema::Compiled {
  explicit Compiled(const json& document) {
    valijson::SchemaParser().populateSchema(valijson::adapters::NlohmannJsonAdapter(document),
                                            schema);
  }
  valijson::Schema schema;
};

JsonSchema::JsonSchema(json schema)
    : document_(std::move(schema)), compiled_(std::make_unique<Compiled>(document_)) {}
JsonSchema::~JsonSchema() = default;
JsonSchema::JsonSchema(JsonSchema&&) noexcept = default;
JsonSchema& JsonSchema::operator=(JsonSchema&&) noexcept = default;

std::vector<Problem> JsonSchema::problems(const json& value, const std::string& source) const {
  valijson::Validator validator;
  valijson::ValidationResults results;
  json numbers = value;
  use_integers(numbers);
  const Rules all(document_);
  std::vector<Problem> problems;
  add_control_characters(value, all.at({}), all, json::json_pointer(), source, problems);
  if (validator.validate(compiled_->schema, valijson::adapters::NlohmannJsonAdapter(numbers),
                         &results)) {
    return problems;
  }
  for (const auto& [context, innermost] : innermost_places(results)) {
    const json::json_pointer place = pointer_to(context);
    const json& at_place = value.at(place);
    const json& rules = all.at(context);
    const std::size_t before = problems.size();
    // Objects that have unknown or missing fields themselves.
    if (at_place.is_object() && rules.contains("properties")) {
      add_field_problems(at_place, rules, all, place, source, problems);
    }
    if (innermost && problems.size() == before) {
      problems.push_back(problem_of_value(at_place, rules, place.to_string(), source));
    }
  }
  check(!problems.empty(), "a document that breaks the schema has a problem");
  return problems;
}

void add_other_places(std::vector<Problem>& problems, std::vector<Problem> more) {
  const std::size_t before = problems.size();
  for (Problem& problem : more) {
    const bool is_there =
        std::any_of(problems.begin(), problems.begin() + static_cast<std::ptrdiff_t>(before),
                    [&](const Problem& other) {
                      return is_at_or_below(other.where, problem.where) ||
                             is_at_or_below(problem.where, other.where);
                    });
    if (!is_there) problems.push_back(std::move(problem));
  }
}

}  // namespace throng::schemas
