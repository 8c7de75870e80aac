#include "base/json/json_describe.h"

#include <fmt/core.h>

#include <nlohmann/json.hpp>

namespace throng {

using nlohmann::json;

namespace {

std::string summary_of(const json& value) {
  return value.is_object() ? "an object" : fmt::format("an array of {}", value.size());
}

/// As a person writes it: [4, 2, 1], with a space after each comma.
std::string text_of(const json& value) {
  if (!value.is_structured()) return value.dump(-1, ' ', true, json::error_handler_t::replace);
  std::string text;
  for (const auto& [key, item] : value.items()) {
    if (!text.empty()) text += ", ";
    if (value.is_object()) text += text_of(key) + ": ";
    // Lists and objects of many items are long in any case.
    text += item.is_structured() && item.size() > 4 ? summary_of(item) : text_of(item);
  }
  return value.is_object() ? "{" + text + "}" : "[" + text + "]";
}

}  // namespace

std::string describe(const json& value) {
  constexpr std::size_t kMaxShownBytes = 60;
  constexpr std::size_t kMaxShownItems = 12;
  if (value.size() > kMaxShownItems) return summary_of(value);
  std::string text = text_of(value);
  if (text.size() <= kMaxShownBytes) return text;
  return value.is_structured() ? summary_of(value) : text.substr(0, kMaxShownBytes) + "...";
}

}  // namespace throng
