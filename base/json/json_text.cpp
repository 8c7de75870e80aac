#include "base/json/json_text.h"

#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/json/json_fault.h"

namespace throng {

namespace {

using nlohmann::json;
using OnElement = std::function<void(const json&)>;

constexpr std::size_t kMaxShownBytes = 60;

/// Text of a client in a message: short, and valid UTF-8 wherever it is cut.
std::string shown(std::string_view text, std::size_t max_bytes = kMaxShownBytes) {
  if (text.size() <= max_bytes) return std::string(text);
  std::size_t end = max_bytes;
  constexpr unsigned kContinuationMask = 0xc0;
  constexpr unsigned kContinuation = 0x80;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & kContinuationMask) == kContinuation) {
    --end;
  }
  return std::string(text.substr(0, end)) + "...";
}

/// Builds the value from the parser's events as long as they are within the limits.
class ValueBuilder final : public nlohmann::json_sax<json> {
 public:
  ValueBuilder(std::string_view text, const JsonLimits& limits, std::string list_key = {},
               OnElement on_element = {}, std::string_view what = "text")
      : text_(text),
        what_(what),
        limits_(limits),
        list_key_(std::move(list_key)),
        on_element_(std::move(on_element)) {}

  json take() { return std::move(root_); }
  const std::optional<Problem>& problem() const { return problem_; }

  bool null() override { return add(nullptr) != nullptr; }
  bool boolean(bool value) override { return add(value) != nullptr; }
  bool number_integer(number_integer_t value) override { return add(value) != nullptr; }
  bool number_unsigned(number_unsigned_t value) override { return add(value) != nullptr; }
  bool number_float(number_float_t value, const string_t& written) override {
    if (written.size() > limits_.max_number_chars) {
      return fail(fmt::format("a number of {} characters", written.size()),
                  fmt::format("at most {}", limits_.max_number_chars));
    }
    // A zero has no sign, so that it is written alike wherever it comes from.
    return add(value + 0.0) != nullptr;
  }
  bool string(string_t& value) override { return add(std::move(value)) != nullptr; }
  bool binary(binary_t& value) override { return add(std::move(value)) != nullptr; }
  bool start_object(std::size_t) override { return open(json::object()); }
  bool start_array(std::size_t) override { return open(json::array()); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }

  bool key(string_t& name) override {
    if (name.size() > limits_.max_key_bytes) {
      return fail(fmt::format("a key of {} bytes", name.size()),
                  fmt::format("at most {}", limits_.max_key_bytes));
    }
    auto& members = open_.back()->get_ref<json::object_t&>();
    if (members.size() >= limits_.max_object_keys) {
      return fail(fmt::format("more than {} keys in one object", limits_.max_object_keys),
                  "fewer keys");
    }
    const auto [at, is_new] = members.emplace(std::move(name), nullptr);
    if (!is_new) {
      return fail(fmt::format("the key \"{}\" twice in one object", shown(at->first)),
                  "every key once");
    }
    member_ = &at->second;
    if (open_.size() == 1) is_in_list_ = on_element_ && at->first == list_key_;
    return true;
  }

  bool parse_error(std::size_t position, const std::string& token,
                   const nlohmann::detail::exception& error) override {
    problem_ = json_fault(text_, what_);
    if (!problem_->found.empty()) return false;
    // The grammar is kept, but a number or half of a character has no value.
    if (dynamic_cast<const json::out_of_range*>(&error) != nullptr) {
      problem_ = Problem{"", pointer(), "the number " + shown(token),
                         "a number within the range of a double, 1.8e308"};
    } else {
      problem_ = Problem{"", text_position(text_, position > 0 ? position - 1 : 0),
                         "half of a character, a lone surrogate", "\\u escapes in pairs"};
    }
    return false;
  }

 private:
  template <typename Value>
  json* add(Value&& value) {
    if (++values_ > limits_.max_values) {
      fail(fmt::format("more than {} values", limits_.max_values), "a smaller document");
      return nullptr;
    }
    if (open_.empty()) {
      root_ = std::forward<Value>(value);
      return &root_;
    }
    json& parent = *open_.back();
    if (parent.is_array()) {
      auto& elements = parent.get_ref<json::array_t&>();
      elements.emplace_back(std::forward<Value>(value));
      return &elements.back();
    }
    *member_ = std::forward<Value>(value);
    return member_;
  }

  bool open(json&& empty) {
    if (open_.size() == limits_.max_depth) {
      return fail(
          fmt::format("more than {} arrays and objects within each other", limits_.max_depth),
          "a flatter document");
    }
    json* const added = add(std::move(empty));
    if (added == nullptr) return false;
    open_.push_back(added);
    return true;
  }

  bool close() {
    constexpr std::size_t kElementDepth = 2;
    open_.pop_back();
    if (!is_in_list_ || open_.size() != kElementDepth || !open_.back()->is_array()) return true;
    auto& list = open_.back()->get_ref<json::array_t&>();
    on_element_(list.back());
    list.clear();
    return true;
  }

  bool fail(std::string found, std::string expected) {
    problem_ = Problem{"", pointer(), std::move(found), std::move(expected)};
    return false;
  }

  /// The pointer of the innermost open array or object.
  std::string pointer() const {
    json::json_pointer pointer;
    for (std::size_t i = 1; i < open_.size(); ++i) {
      const json& parent = *open_[i - 1];
      if (parent.is_array()) {
        pointer.push_back(std::to_string(parent.size() - 1));
        continue;
      }
      const auto& members = parent.get_ref<const json::object_t&>();
      const auto at = std::find_if(members.begin(), members.end(),
                                   [&](const auto& member) { return &member.second == open_[i]; });
      if (at != members.end()) pointer.push_back(at->first);
    }
    return shown(pointer.to_string());
  }

  std::string_view text_;
  std::string_view what_;  ///< "file" or "body"
  const JsonLimits& limits_;
  std::string list_key_;
  OnElement on_element_;
  json root_;
  std::vector<json*> open_;  ///< from the root inwards; only the innermost one changes
  json* member_ = nullptr;   ///< of the innermost object: the place for the value of its last key
  bool is_in_list_ = false;
  std::size_t values_ = 0;
  std::optional<Problem> problem_;
};

/// The value, or what is wrong with the text.
std::optional<Problem> read(std::string_view text, const JsonLimits& limits,
                            ValueBuilder& builder) {
  if (text.size() > limits.max_bytes) {
    return Problem{"", "", fmt::format("{} bytes", text.size()),
                   fmt::format("at most {}", limits.max_bytes)};
  }
  json::sax_parse(text.begin(), text.end(), &builder);
  // The parser takes a zero byte for the end, whatever follows.
  const auto zero = builder.problem() ? std::string_view::npos : text.find('\0');
  if (zero != std::string_view::npos) {
    return Problem{"", text_position(text, zero), "a zero byte", "text without zero bytes"};
  }
  return builder.problem();
}

json own_value(std::string_view text, const std::string& what, ValueBuilder& builder) {
  if (const auto problem = read(text, kOwnJsonLimits, builder)) {
    throw EnvironmentError(fmt::format("{} is damaged: {}", what, problem->text()));
  }
  return builder.take();
}

}  // namespace

json parse_json(std::string_view text, const std::string& source, const JsonLimits& limits) {
  ValueBuilder builder(text, limits, {}, {}, source.empty() ? "body" : "file");
  if (auto problem = read(text, limits, builder)) {
    problem->source = source;
    throw InputError(std::move(*problem));
  }
  return builder.take();
}

json parse_own_json(std::string_view text, const std::string& what) {
  ValueBuilder builder(text, kOwnJsonLimits);
  return own_value(text, what, builder);
}

json parse_json_or_discard(std::string_view text, const JsonLimits& limits) {
  ValueBuilder builder(text, limits);
  return read(text, limits, builder) ? json(json::value_t::discarded) : builder.take();
}

nlohmann::ordered_json parse_ordered_json(std::string_view text) {
  // Values are printed recursively.
  const auto is_shallow = [](int depth, auto, const auto&) {
    if (std::cmp_greater(depth, JsonLimits{}.max_depth)) {
      throw nlohmann::json::other_error::create(501, "too many levels of nesting", nullptr);
    }
    return true;
  };
  return nlohmann::ordered_json::parse(text, is_shallow);
}

bool is_own_json(std::string_view text) { return json::accept(text); }

json parse_own_json_list(std::string_view text, const std::string& what,
                         const std::string& list_key, const OnElement& on_element) {
  ValueBuilder builder(text, kOwnJsonLimits, list_key, on_element);
  return own_value(text, what, builder);
}

}  // namespace throng
