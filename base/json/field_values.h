// Permitted values of fields (base/json/field_table.h), for checks, schemas and sampling.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace throng::fields {

/// Conversion between a field's JSON values (numbers, times, words) and numbers, for sampling.
struct Quantity {
  std::string expected;  ///< permitted single values, for messages: "a number from 0 to 90"
  /// Converts a value to a number; nothing if the value is not permitted.
  std::function<std::optional<double>(const nlohmann::json&)> number;
  /// Converts a number to a value.
  std::function<nlohmann::json(double)> json;
  double low = 0;  ///< min of the numbers
  /// Max of the numbers.
  double high = 0;
  bool continuous = true;  ///< false: only the distribution "choice" is permitted
};

/// Returns the conversion for numbers from `low` to `high`.
Quantity number_quantity(double low, double high);

/// The permitted values of a field.
struct Values {
  nlohmann::ordered_json rules;  ///< keywords of JSON Schema, "type" first
  std::string expected = {};     ///< for messages, if the rules do not express it (x-expected)
  std::optional<Quantity> quantity = std::nullopt;  ///< set if the field may be sampled
  /// Whether a text has the "pattern" of the rules; nothing: the field's setter checks it.
  std::function<bool(std::string_view)> has_pattern = {};
};

Values integers(std::int64_t low, std::int64_t high);
Values numbers(double low, double high);
/// Numbers greater than `low` and at most `high`.
Values numbers_above(double low, double high);
Values booleans();
/// Texts of `min_length` to `max_length` characters.
Values texts(int min_length, int max_length);
/// Texts of 1 to 32 letters, digits, '_' and '-'.
Values identifiers();
/// Names of letters, digits, '_' and '-', of any length or at most `max_length` characters.
Values names(std::optional<std::size_t> max_length = std::nullopt);
/// Texts that match a regular expression (JSON Schema "pattern").
Values texts_like(const std::string& pattern, const std::string& expected);
/// Lists of `min_items` to `max_items` items.
Values lists(int min_items, int max_items, nlohmann::ordered_json items);
/// Lists of at least `min_items` items.
Values open_lists(int min_items, nlohmann::ordered_json items);
/// Objects with the schema() of a table.
Values object_with(const nlohmann::ordered_json& fields);
/// The rules of such objects as one of several forms of a value, which `help` describes.
nlohmann::ordered_json form(std::string help, const nlohmann::ordered_json& fields);
/// Other rules of JSON Schema.
Values raw(nlohmann::ordered_json rules, std::string expected = "");

/// One of several words.
Values one_of_words(std::span<const std::string> words);
template <typename Words>
std::vector<std::string> to_texts(const Words& words) {
  return {words.begin(), words.end()};
}
template <typename Words>
Values one_of_words(const Words& words) {
  const std::vector<std::string> texts = to_texts(words);
  return one_of_words(std::span<const std::string>(texts));
}
/// Returns the value as schemas write it: integers without a decimal point.
nlohmann::ordered_json plain_numbers(const nlohmann::json& value);

/// Returns the value at a path such as "sensor/iso", or null.
const nlohmann::json* value_at(const nlohmann::json& object, std::string_view path);
/// Returns the JSON pointer of such a path.
nlohmann::json::json_pointer pointer_below(const std::string& path);

}  // namespace throng::fields
