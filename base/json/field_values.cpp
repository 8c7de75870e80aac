#include "base/json/field_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/json/json_integer.h"
#include "base/text/control_characters.h"

namespace throng::fields {

using nlohmann::json;
using nlohmann::ordered_json;

namespace {

/// A number without a point where it is whole.
ordered_json plain(double number) {
  constexpr double kExact = 9'007'199'254'740'992;
  if (std::abs(number) <= kExact && number == std::trunc(number)) {
    return static_cast<std::int64_t>(number);
  }
  return number;
}

}  // namespace

Quantity number_quantity(double low, double high) {
  return {fmt::format("a number from {} to {}", low, high),
          [low, high](const json& value) -> std::optional<double> {
            if (!value.is_number()) return std::nullopt;
            const auto number = value.get<double>();
            return number >= low && number <= high ? std::optional(number) : std::nullopt;
          },
          [](double number) { return json(number); },
          low,
          high,
          true};
}

Values integers(std::int64_t low, std::int64_t high) {
  Quantity quantity = number_quantity(static_cast<double>(low), static_cast<double>(high));
  quantity.expected = fmt::format("an integer from {} to {}", low, high);
  quantity.number = [number = quantity.number](const json& value) {
    return is_integer(value) ? number(value) : std::nullopt;
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
  return {
      {{"type", "string"}, {"minLength", min_length}, {"maxLength", max_length}, {kOneLine, true}}};
}

Values identifiers() {
  constexpr std::size_t kMaxLength = 32;
  Values values = names(kMaxLength);
  values.expected = fmt::format("1 to {} letters, digits, '_' or '-'", kMaxLength);
  return values;
}

Values names(std::optional<std::size_t> max_length) {
  Values values = texts_like(
      fmt::format("^[A-Za-z0-9_-]{}$", max_length ? fmt::format("{{1,{}}}", *max_length) : "+"),
      fmt::format("a name of letters, digits, '_' and '-'{}",
                  max_length ? fmt::format(", of at most {} characters", *max_length) : ""));
  values.has_pattern = [max_length](std::string_view text) {
    const auto is_allowed = [](char c) {
      return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
             c == '_' || c == '-';
    };
    return !text.empty() && (!max_length || text.size() <= *max_length) &&
           std::all_of(text.begin(), text.end(), is_allowed);
  };
  return values;
}

Values texts_like(const std::string& pattern, const std::string& expected) {
  return {{{"type", "string"}, {"pattern", pattern}}, expected};
}

Values lists(int min_items, int max_items, ordered_json items) {
  return {{{"type", "array"},
           {"minItems", min_items},
           {"maxItems", max_items},
           {"items", std::move(items)}}};
}

Values open_lists(int min_items, ordered_json items) {
  ordered_json rules = {{"type", "array"}};
  if (min_items > 0) rules["minItems"] = min_items;
  rules["items"] = std::move(items);
  return {std::move(rules),
          min_items > 0 ? fmt::format("an array of at least {}", min_items) : "an array"};
}

Values object_with(const ordered_json& fields) {
  ordered_json rules = {{"type", "object"}};
  rules.update(fields);
  return {std::move(rules)};
}

ordered_json form(std::string help, const ordered_json& fields) {
  ordered_json rules = {{"description", std::move(help)}};
  rules.update(object_with(fields).rules);
  return rules;
}

Values raw(ordered_json rules, std::string expected) {
  return {std::move(rules), std::move(expected)};
}

Values one_of_words(std::span<const std::string> words) {
  ordered_json list = ordered_json::array();
  for (const std::string& word : words) list.push_back(word);
  return {{{"type", "string"}, {"enum", std::move(list)}}};
}

ordered_json plain_numbers(const json& value) {
  if (value.is_number_float()) return plain(value.get<double>());
  return value;
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

json::json_pointer pointer_below(const std::string& path) { return json::json_pointer("/" + path); }

}  // namespace throng::fields
