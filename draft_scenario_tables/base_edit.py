import re
def sub(path, old, new, count=1):
    text = open(path, encoding="utf-8").read()
    assert text.count(old) >= 1, (path, old)
    open(path, "w", encoding="utf-8").write(text.replace(old, new, count))

h = "base/json/field_check.h"
sub(h, """  /// Warns that the document uses""", """  FieldLocation below(std::size_t index) const { return below(std::to_string(index)); }
  /// Adds a problem with the value at this position.
  void reject(std::string found, std::string expected) const;
  /// Returns whether there is a problem with the value at `path` or below it: rules that span
  /// several fields hold only for valid ones.
  bool has_problem(std::string_view path) const;
  /// Warns that the document uses""")
sub(h, "#include <string>\n", "#include <string>\n#include <string_view>\n")
sub(h, """/// Checks a value against the type, words, range and length of a field; adds a problem and returns
/// false if it breaks them. Patterns are checked by the field's setter.
""", """/// Checks a value, and the elements of a list, against the type, words, range and length of a field;
/// adds problems and returns false if it breaks them. Patterns and elements with fields of their own
/// are checked by the field's setter.
""")
c = "base/json/field_check.cpp"
sub(c, """bool check_value(const json& value, const FieldRules& field, const FieldLocation& place) {
  const ordered_json& rules = field.values.rules;
  if (keeps_type(value, rules.at("type")) && keeps_words(value, rules) &&
      keeps_range(value, rules)) {
    return true;
  }
  place.problems.push_back(
      {place.source, place.pointer, describe(value), describe_expected(field)});
  return false;
}
""", """void FieldLocation::reject(std::string found, std::string expected) const {
  problems.push_back({source, pointer, std::move(found), std::move(expected)});
}

bool FieldLocation::has_problem(std::string_view path) const {
  const std::string whole = fmt::format("{}/{}", pointer, path);
  return std::any_of(problems.begin(), problems.end(), [&](const Problem& problem) {
    return problem.where == whole || problem.where.starts_with(whole + "/");
  });
}

bool check_value(const json& value, const FieldRules& field, const FieldLocation& place) {
  const ordered_json& rules = field.values.rules;
  if (!keeps_rules(value, rules)) {
    place.reject(describe(value), describe_expected(field));
    return false;
  }
  return !value.is_array() || check_elements(value, rules, place);
}
""")
sub(c, """/// The part of a path after its last '/'.
""", """bool keeps_rules(const json& value, const ordered_json& rules) {
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
""")
h = "base/json/field_schema.h"
text = open(h).read(); print(text)
c = "base/json/field_schema.cpp"
sub(c, """  ordered_json rules = {{"title", field.title}, {"description", field.help}};
  for""", """  ordered_json rules;
  if (!field.title.empty()) rules["title"] = field.title;
  rules["description"] = field.help;
  for""")
sub(c, """  ordered_json rules = {{"title", group.title},
                        {"description", group.help},
                        {"type", "object"},
                        {"additionalProperties", false}};
""", """  ordered_json rules;
  if (!group.title.empty()) rules["title"] = group.title;
  rules["description"] = group.help;
  rules["type"] = "object";
  rules["additionalProperties"] = false;
""")
sub(c, """std::string schema_text(const ordered_json& schema) {""", """ordered_json document_schema(const std::string& title, const std::string& description,
                             const ordered_json& fields) {
  ordered_json schema = {{"$schema", "http://json-schema.org/draft-07/schema#"},
                         {"title", title},
                         {"description", description},
                         {"type", "object"}};
  schema.update(fields);
  schema["properties"]["$schema"] = {
      {"description", "The schema that an editor completes and checks with."}, {"type", "string"}};
  return schema;
}

std::string schema_text(const ordered_json& schema) {""")
t = "base/json/field_table.h"
sub(t, """  /// Adds the fields of a part of the object, with the prefix `path`.
""", """  /// Adds an object with fields of its own that may be missing, in which case it stays empty.
  template <typename Part, typename Access>
  Field<Object>& add_object(std::string path, const FieldTable<Part>& part, Access access,
                            std::string help) {
    return add(
        std::move(path), "", "", object_with(part.schema()),
        [&part, access](const Object& object) {
          const std::optional<Part>& value = access(object);
          return value ? part.print(*value) : nlohmann::json();
        },
        [&part, access](Object& object, const nlohmann::json& value, const FieldLocation& place) {
          part.read_checked(value, access(object).emplace(), place);
        },
        std::move(help));
  }

  /// Adds the fields of a part of the object, with the prefix `path`.
""")
