// Strict reading of JSON: each field has a name, a type and a range. All problems of a document are
// reported together, each with its JSON pointer.
#pragma once

#include <Eigen/Core>
#include <initializer_list>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace throng::fields {
struct FieldLocation;
}  // namespace throng::fields

namespace throng::world {

/// A value of a document, or a missing value, with its JSON pointer. Reading a value of a wrong
/// type or out of range records a problem and returns a default within the range, so that reading
/// continues. Reading a missing value, or a field below one, returns a default and records nothing.
class JsonValue {
 public:
  /// The root of a document. Problems are appended to `problems`; `source` is the name of the file
  /// in them. All three arguments must outlive the value.
  JsonValue(const nlohmann::json& document, const std::string& source,
            std::vector<Problem>& problems);

  /// Declares the required and optional fields of this object; other fields are problems, except
  /// "$schema" at the root. `deprecated` lists old names that are accepted but not suggested: see
  /// renamed().
  void fields(std::initializer_list<std::string_view> required,
              std::initializer_list<std::string_view> optional = {},
              std::initializer_list<std::string_view> deprecated = {}) const;

  /// Returns the field of this object, or a missing value.
  JsonValue operator[](std::string_view key) const;
  /// Returns the field `key`; if the document has its deprecated name instead, that field with a
  /// warning on stderr. Both together are a problem.
  JsonValue renamed(std::string_view key, std::string_view deprecated) const;
  bool exists() const { return value_ != nullptr; }
  /// Returns the value, which exists, and its location, for a table of fields.
  const nlohmann::json& value() const { return *value_; }
  fields::FieldLocation location() const;
  bool is_number() const;
  bool is_text() const;
  bool is_list_of(std::size_t count) const;

  /// Returns a number of the closed range [low, high]; `low` if there is none.
  double number(double low, double high) const;
  int integer(int low, int high) const;
  bool boolean() const;
  std::string text() const;
  /// Text of at least one character, each a letter, a digit, '_' or '-'.
  std::string identifier() const;
  /// Returns the elements of an array; records a problem for fewer than `at_least` elements.
  std::vector<JsonValue> items(std::size_t at_least = 0) const;
  /// Returns the elements of an array of `count` elements; otherwise records `expected` and returns
  /// none.
  std::vector<JsonValue> tuple(std::size_t count, std::string_view expected) const;
  /// Returns a vector whose coordinates are at most `limit` in absolute value.
  Eigen::Vector2d vector2(double limit) const;
  Eigen::Vector3d vector3(double limit) const;

  /// Records a problem with this value: `expected` says what is allowed, `found` what the document
  /// has (by default a description of the value; a missing value is then no problem).
  void reject(std::string expected) const;
  void reject(std::string found, std::string expected) const;

 private:
  JsonValue(const nlohmann::json* value, std::string pointer, const std::string* source,
            std::vector<Problem>* problems);

  const nlohmann::json* value_;  ///< null: missing
  std::string pointer_;
  const std::string* source_;
  std::vector<Problem>* problems_;
};

}  // namespace throng::world
