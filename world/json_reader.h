// Strict reading of JSON: every field is named, typed and bounded, and all that is wrong with a
// document is reported at once, each with its JSON pointer.
#pragma once

#include <Eigen/Core>
#include <initializer_list>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace throng::world {

/// A value of a document and its place. Reading something of the wrong kind records a problem and
/// returns a harmless value, so that reading goes on; reading below a value that is missing
/// records nothing more.
class JsonValue {
 public:
  /// The root of a document; problems go to `problems`. All three must outlive the value.
  JsonValue(const nlohmann::json& document, const std::string& source,
            std::vector<Problem>& problems);

  /// Declares the required and optional fields of the object here; anything else is a problem.
  /// `deprecated` are old names that are accepted, but not suggested: see renamed().
  void fields(std::initializer_list<std::string_view> required,
              std::initializer_list<std::string_view> optional = {},
              std::initializer_list<std::string_view> deprecated = {}) const;

  /// The field of an object; a missing value when there is none.
  JsonValue operator[](std::string_view key) const;
  /// The same, or, with a warning, the field with its deprecated name. Both at once are a problem.
  JsonValue renamed(std::string_view key, std::string_view deprecated) const;
  bool exists() const { return value_ != nullptr; }
  bool is_number() const;
  bool is_text() const;
  bool is_list_of(std::size_t count) const;

  double number(double low, double high) const;
  int integer(int low, int high) const;
  bool boolean() const;
  std::string text() const;
  /// Text that is an identifier: letters, digits, '_' and '-', at least one.
  std::string identifier() const;
  /// The elements of an array of at least `at_least` elements.
  std::vector<JsonValue> items(std::size_t at_least = 0) const;
  /// The elements of an array of exactly `count` elements; empty when it is anything else.
  std::vector<JsonValue> tuple(std::size_t count, std::string_view expected) const;
  Eigen::Vector2d vector2(double limit) const;
  Eigen::Vector3d vector3(double limit) const;

  /// Records that this value is not what it should be.
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
