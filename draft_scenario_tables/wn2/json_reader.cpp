#include "world/json_reader.h"

#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/json/deprecation.h"
#include "base/json/field_table.h"
#include "base/json/json_describe.h"
#include "base/json/json_integer.h"
#include "base/text/suggest.h"

namespace throng::world {

using nlohmann::json;

namespace {

/// Names the schema that an editor checks a document with; nothing to us.
constexpr const char* kSchemaField = "$schema";

// Keys are escaped as RFC 6901 wants it.
std::string escaped(std::string_view key) {
  std::string text;
  for (const char c : key) {
    if (c == '~') {
      text += "~0";
    } else if (c == '/') {
      text += "~1";
    } else {
      text += c;
    }
  }
  return text;
}

}  // namespace

JsonValue::JsonValue(const json& document, const std::string& source,
                     std::vector<Problem>& problems)
    : JsonValue(&document, "", &source, &problems) {}

JsonValue::JsonValue(const json* value, std::string pointer, const std::string* source,
                     std::vector<Problem>* problems)
    : value_(value), pointer_(std::move(pointer)), source_(source), problems_(problems) {}

void JsonValue::reject(std::string found, std::string expected) const {
  problems_->push_back({*source_, pointer_, std::move(found), std::move(expected)});
}

void JsonValue::reject(std::string expected) const {
  if (value_ != nullptr) reject(describe(*value_), std::move(expected));
}

void JsonValue::fields(std::initializer_list<std::string_view> required,
                       std::initializer_list<std::string_view> optional,
                       std::initializer_list<std::string_view> deprecated) const {
  if (value_ == nullptr) return;
  if (!value_->is_object()) return reject("an object");
  for (const std::string_view key : required) {
    if (!value_->contains(key))
      reject(fmt::format("missing required field \"{}\"", key), fmt::format("\"{}\"", key));
  }
  std::vector<std::string_view> known(required);
  known.insert(known.end(), optional.begin(), optional.end());
  for (const auto& [key, child] : value_->items()) {
    if (pointer_.empty() && key == kSchemaField) continue;
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    if (std::find(deprecated.begin(), deprecated.end(), key) != deprecated.end()) continue;
    problems_->push_back(
        unknown_name(*source_, pointer_ + "/" + escaped(key), "field", key, known));
  }
}

JsonValue JsonValue::operator[](std::string_view key) const {
  const json* child = nullptr;
  if (value_ != nullptr && value_->is_object()) {
    const auto found = value_->find(key);
    if (found != value_->end()) child = &*found;
  }
  return {child, pointer_ + "/" + escaped(key), source_, problems_};
}

JsonValue JsonValue::renamed(std::string_view key, std::string_view deprecated) const {
  const JsonValue value = (*this)[key];
  const JsonValue old = (*this)[deprecated];
  if (!old.exists()) return value;
  if (value.exists()) {
    old.reject(fmt::format("both \"{}\" and \"{}\"", key, deprecated),
               fmt::format("only \"{}\"", key));
    return value;
  }
  warn_deprecated(*source_, old.pointer_, key);
  return old;
}

fields::FieldLocation JsonValue::location() const { return {pointer_, *source_, *problems_}; }

bool JsonValue::is_number() const { return value_ != nullptr && value_->is_number(); }

bool JsonValue::is_text() const { return value_ != nullptr && value_->is_string(); }

bool JsonValue::is_list_of(std::size_t count) const {
  return value_ != nullptr && value_->is_array() && value_->size() == count;
}

double JsonValue::number(double low, double high) const {
  if (value_ == nullptr) return low;
  const double value = value_->is_number() ? value_->get<double>() : low - 1;
  if (value >= low && value <= high) return value;
  reject(fmt::format("a number from {} to {}", low, high));
  return low;
}

int JsonValue::integer(int low, int high) const {
  if (value_ == nullptr) return low;
  if (is_integer(*value_)) {
    // Through double: an unsigned value beyond the range of int64 must not wrap around.
    const double value = value_->get<double>();
    if (value >= low && value <= high) return static_cast<int>(value);
  }
  reject(fmt::format("an integer from {} to {}", low, high));
  return low;
}

bool JsonValue::boolean() const {
  if (value_ == nullptr) return false;
  if (value_->is_boolean()) return value_->get<bool>();
  reject("true or false");
  return false;
}

std::string JsonValue::text() const {
  if (value_ == nullptr) return {};
  if (value_->is_string()) return value_->get<std::string>();
  reject("text");
  return {};
}

std::string JsonValue::identifier() const {
  if (value_ == nullptr) return {};
  const auto is_word = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-';
  };
  if (value_->is_string()) {
    const auto& word = value_->get_ref<const std::string&>();
    if (!word.empty() && std::all_of(word.begin(), word.end(), is_word)) return word;
  }
  reject("a name of letters, digits, '_' and '-'");
  return {};
}

std::vector<JsonValue> JsonValue::items(std::size_t at_least) const {
  if (value_ == nullptr) return {};
  if (!value_->is_array() || value_->size() < at_least) {
    reject(at_least == 0 ? "an array" : fmt::format("an array of at least {}", at_least));
    return {};
  }
  std::vector<JsonValue> values;
  for (std::size_t i = 0; i < value_->size(); ++i) {
    values.push_back({&(*value_)[i], fmt::format("{}/{}", pointer_, i), source_, problems_});
  }
  return values;
}

std::vector<JsonValue> JsonValue::tuple(std::size_t count, std::string_view expected) const {
  if (value_ == nullptr) return {};
  if (is_list_of(count)) return items();
  reject(std::string(expected));
  return {};
}

Eigen::Vector2d JsonValue::vector2(double limit) const {
  const auto parts = tuple(2, "[x, y]");
  if (parts.empty()) return Eigen::Vector2d::Zero();
  return {parts[0].number(-limit, limit), parts[1].number(-limit, limit)};
}

Eigen::Vector3d JsonValue::vector3(double limit) const {
  const auto parts = tuple(3, "[x, y, z]");
  if (parts.empty()) return Eigen::Vector3d::Zero();
  return {parts[0].number(-limit, limit), parts[1].number(-limit, limit),
          parts[2].number(-limit, limit)};
}

}  // namespace throng::world
