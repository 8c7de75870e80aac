#include "base/json/json_describe.h"

#include <fmt/core.h>

#include <nlohmann/json.hpp>

namespace throng {

using nlohmann::json;

namespace {

std::string summarize(const json& value) {
  return value.is_object() ? "an object" : fmt::format("an array of {}", value.size());
}

/// As a person writes it: [4, 2, 1], with a space after each comma.
std::string quote_value(const json& value) {
  if (!value.is_structured()) return value.dump(-1, ' ', true, json::error_handler_t::replace);
  std::string text;
  for (const auto& [key, item] : value.items()) {
    if (!text.empty()) text += ", ";
    if (value.is_object()) text += quote_value(key) + ": ";
    // Lists and objects of many items are long in any case.
    text += item.is_structured() && item.size() > 4 ? summarize(item) : quote_value(item);
  }
  return value.is_object() ? "{" + text + "}" : "[" + text + "]";
}

}  // namespace

std::string describe(const json& value) {
  constexpr std::size_t kMaxShownBytes = 60;
  constexpr std::size_t kMaxShownItems = 12;
  if (value.size() > kMaxShownItems) return summarize(value);
  std::string text = quote_value(value);
  if (text.size() <= kMaxShownBytes) return text;
  return value.is_structured() ? summarize(value) : text.substr(0, kMaxShownBytes) + "...";
}

}  // namespace throng
