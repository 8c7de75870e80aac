// JSON Schemas of what routes take and answer, in short.
#pragma once

#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

#include "base/json/field_table.h"

namespace throng::server {

/// A JSON Schema. As text: "string", "integer", "number", "boolean", "object", "any", "time"
/// (RFC 3339), "binary", or the name of a schema of the API such as "Job", followed by any of "?"
/// (or null), "[]" (a list) and "[3]" (a list of 3): "number?[2]".
class ValueType {
 public:
  ValueType(const char* text);              // NOLINT(google-explicit-constructor)
  ValueType(const fields::Values& values);  // NOLINT(google-explicit-constructor)
  explicit ValueType(nlohmann::ordered_json schema) : schema_(std::move(schema)) {}

  const nlohmann::ordered_json& schema() const { return schema_; }

 private:
  nlohmann::ordered_json schema_;
};

/// A member of an object.
struct Member {
  std::string_view name;  ///< with "?" at its end if it may be left out
  ValueType type;
  const char* help = "";
};

/// Objects that have these members, and perhaps others.
ValueType object(const std::vector<Member>& members);
/// Objects that have no other members.
ValueType closed(const std::vector<Member>& members);
/// Objects whose members all have one type.
ValueType map(const ValueType& values);
ValueType list(const ValueType& items);
ValueType at_least_one(const ValueType& items);
ValueType list(const ValueType& items, std::size_t min_items, std::size_t max_items);
ValueType nullable(const ValueType& type);
/// Values of all, or of one, of these types.
ValueType intersection(const std::vector<ValueType>& types);
ValueType alternatives(const std::vector<ValueType>& types);
ValueType constant(const nlohmann::ordered_json& value);
ValueType text_up_to(std::size_t max_length);
ValueType at_least(std::int64_t min_number);
ValueType with_default(const ValueType& type, const nlohmann::ordered_json& usual);
ValueType words(const std::vector<std::string_view>& words);
/// The words of an enumeration's values from `first` to `last`.
template <typename Enum>
ValueType enumeration(Enum first, Enum last) {
  std::vector<std::string_view> names;
  for (int i = static_cast<int>(first); i <= static_cast<int>(last); ++i) {
    names.push_back(to_string(static_cast<Enum>(i)));
  }
  return words(names);
}

}  // namespace throng::server
