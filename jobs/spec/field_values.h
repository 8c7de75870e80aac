// Permitted values of a job's fields, for the schema and for sampling them.
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "jobs/spec/distribution.h"

namespace throng::jobs {

struct FieldRules;

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
/// `count` coordinates in m; `is_random`: the block "randomize" may name each.
Values coordinates(int count, bool is_random = false);
/// Objects with the fields of a table: its schema().
Values object_of(const nlohmann::ordered_json& fields);
/// Any other rules of the schema.
Values raw(nlohmann::ordered_json rules, std::string expected = "");

/// Some of words, as they are written in JSON.
Values one_of(std::span<const std::string> words);
/// One of these words, or a choice of them for each run.
Values sampled_words(std::span<const std::string> words);

template <typename Words>
std::vector<std::string> texts_of(const Words& words) {
  return {words.begin(), words.end()};
}
template <typename Words>
Values one_of(const Words& words) {
  const std::vector<std::string> texts = texts_of(words);
  return one_of(std::span<const std::string>(texts));
}
template <typename Words>
Values sampled_words(const Words& words) {
  const std::vector<std::string> texts = texts_of(words);
  return sampled_words(std::span<const std::string>(texts));
}

/// The value as the schema writes it: whole numbers without a point.
nlohmann::ordered_json plain_numbers(const nlohmann::json& value);

/// A field that is sampled, as a job writes it; null if it is not there.
nlohmann::json sampled_json(const Distribution& distribution, const Quantity& quantity);
nlohmann::json sampled_json(const std::optional<Distribution>& distribution,
                            const Quantity& quantity);

/// The value at a path like "sensor/iso"; null if it is not there.
const nlohmann::json* value_at(const nlohmann::json& object, std::string_view path);
nlohmann::json::json_pointer pointer_below(const std::string& path);

/// The rules of an object's fields: "additionalProperties", "required" if some are, "properties".
nlohmann::ordered_json schema_of(std::span<const FieldRules* const> fields);

/// A schema as text, one member a line but for short lists.
std::string schema_text(const nlohmann::ordered_json& schema);

}  // namespace throng::jobs
