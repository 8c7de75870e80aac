// Permitted values of fields (base/json/field_table.h): for checks, for schemas and for sampling.
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

/// How one field writes its values: as numbers, times, words.
struct Quantity {
  std::string expected;  ///< what a single value must be, for messages: "a number from 0 to 90"
  /// The value as a number; nothing when it is not one of the field's.
  std::function<std::optional<double>(const nlohmann::json&)> number;
  /// The reverse.
  std::function<nlohmann::json(double)> json;
  double low = 0;  ///< of all values
  double high = 0;
  bool continuous = true;  ///< else only "choice" makes sense
};

/// Numbers from `low` to `high`.
Quantity number_quantity(double low, double high);

struct Values {
  nlohmann::ordered_json rules;  ///< in JSON Schema's words, "type" first
  std::string expected = {};     ///< for messages, where the rules do not say it (x-expected)
  std::optional<Quantity> quantity = std::nullopt;  ///< how values are sampled, if they may be
};

Values integers(std::int64_t low, std::int64_t high);
Values numbers(double low, double high);
/// Numbers above `low`.
Values numbers_above(double low, double high);
Values booleans();
/// Texts of `min_length` to `max_length` characters.
Values texts(int min_length, int max_length);
/// Letters, digits, '_' and '-'.
Values identifiers();
/// Texts that match a regular expression of JSON Schema.
Values texts_like(const std::string& pattern, const std::string& expected);
/// Lists of `min_items` to `max_items` items.
Values lists(int min_items, int max_items, nlohmann::ordered_json items);
/// Objects with the fields of a table: its schema().
Values object_with(const nlohmann::ordered_json& fields);
/// Any other rules of the schema.
Values raw(nlohmann::ordered_json rules, std::string expected = "");

/// Some of words, as they are written in JSON.
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
/// The value as the schema writes it: whole numbers without a point.
nlohmann::ordered_json plain_numbers(const nlohmann::json& value);

/// The value at a path like "sensor/iso"; null if it is not there.
const nlohmann::json* value_at(const nlohmann::json& object, std::string_view path);
nlohmann::json::json_pointer pointer_below(const std::string& path);

}  // namespace throng::fields
