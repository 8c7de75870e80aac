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

/// The pointer of the innermost open array or object. `open` has all open ones, from the root
/// inwards.
std::string pointer_to(const std::vector<json*>& open) {
  json::json_pointer pointer;
  for (std::size_t i = 1; i < open.size(); ++i) {
    const json& parent = *open[i - 1];
    if (parent.is_array()) {
      pointer.push_back(std::to_string(parent.size() - 1));
      continue;
    }
    const auto& members = parent.get_ref<const json::object_t&>();
    const auto at = std::find_if(members.begin(), members.end(),
                                 [&](const auto& member) { return &member.second == open[i]; });
    if (at != members.end()) pointer.push_back(at->first);
  }
  return shown(pointer.to_string());
}

/// A list of the root object whose elements are handed over one by one, so that the whole of it is
/// never in memory.
struct StreamedList {
  std::string key = {};
  OnElement on_element = {};  ///< nothing: no list is streamed
  bool is_open = false;       ///< whether the last key of the root object is that of the list

  /// Hands over the last element of the list if it has just been closed.
  void take_element(const std::vector<json*>& open) const {
    constexpr std::size_t kListDepth = 2;
    if (!is_open || open.size() != kListDepth || !open.back()->is_array()) return;
    auto& list = open.back()->get_ref<json::array_t&>();
    on_element(list.back());
    list.clear();
  }
};

/// A value that grows by one value, key or bracket at a time, within limits. Functions return false
/// after a problem.
class GrowingValue {
 public:
  GrowingValue(const JsonLimits& limits, StreamedList list)
      : limits_(limits), list_(std::move(list)) {}

  json take() { return std::move(root_); }

  template <typename Value>
  bool add(Value&& value) {
    if (++values_ > limits_.max_values) {
      return fail(fmt::format("more than {} values", limits_.max_values), "a smaller document");
    }
    if (open_.empty()) {
      root_ = std::forward<Value>(value);
      last_ = &root_;
    } else if (open_.back()->is_array()) {
      auto& elements = open_.back()->get_ref<json::array_t&>();
      last_ = &elements.emplace_back(std::forward<Value>(value));
    } else {
      *last_ = std::forward<Value>(value);
    }
    return true;
  }

  /// Adds a number that the text writes with this many characters.
  bool add_number(double number, std::size_t chars) {
    if (chars > limits_.max_number_chars) {
      return fail(fmt::format("a number of {} characters", chars),
                  fmt::format("at most {}", limits_.max_number_chars));
    }
    // A zero has no sign, so that it is written alike wherever it comes from.
    return add(number + 0.0);
  }

  /// Opens an array or object; `empty` is an empty one.
  bool open(json&& empty) {
    if (open_.size() == limits_.max_depth) {
      return fail(
          fmt::format("more than {} arrays and objects within each other", limits_.max_depth),
          "a flatter document");
    }
    if (!add(std::move(empty))) return false;
    open_.push_back(last_);
    return true;
  }

  bool close() {
    open_.pop_back();
    list_.take_element(open_);
    return true;
  }

  bool add_key(std::string&& name) {
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
    last_ = &at->second;
    if (open_.size() == 1) list_.is_open = list_.on_element && at->first == list_.key;
    return true;
  }

  /// Records a problem with the innermost open array or object.
  bool fail(std::string found, std::string expected) {
    problem = Problem{"", pointer_to(open_), std::move(found), std::move(expected)};
    return false;
  }

  std::optional<Problem> problem;

 private:
  const JsonLimits& limits_;
  StreamedList list_;
  json root_;
  std::vector<json*> open_;  ///< from the root inwards; only the innermost one changes
  json* last_ = nullptr;     ///< the value added last, or the place for the value of the last key
  std::size_t values_ = 0;
};

/// A text that is read, and its name in messages: "text", "file" or "body".
struct SourceText {
  std::string_view text;
  std::string_view name = "text";
};

/// Passes the parser's events on to a growing value.
struct ParserEvents final : nlohmann::json_sax<json> {
  bool null() override { return value->add(nullptr); }
  bool boolean(bool given) override { return value->add(given); }
  bool number_integer(number_integer_t given) override { return value->add(given); }
  bool number_unsigned(number_unsigned_t given) override { return value->add(given); }
  bool number_float(number_float_t given, const string_t& written) override {
    return value->add_number(given, written.size());
  }
  bool string(string_t& given) override { return value->add(std::move(given)); }
  bool binary(binary_t& given) override { return value->add(std::move(given)); }
  bool start_object(std::size_t /*size*/) override { return value->open(json::object()); }
  bool start_array(std::size_t /*size*/) override { return value->open(json::array()); }
  bool end_object() override { return value->close(); }
  bool end_array() override { return value->close(); }
  bool key(string_t& name) override { return value->add_key(std::move(name)); }

  bool parse_error(std::size_t position, const std::string& token,
                   const nlohmann::detail::exception& error) override {
    value->problem = json_fault(source.text, source.name);
    if (!value->problem->found.empty()) return false;
    // The grammar is kept, but a number or half of a character has no value.
    if (dynamic_cast<const json::out_of_range*>(&error) != nullptr) {
      return value->fail("the number " + shown(token),
                         "a number within the range of a double, 1.8e308");
    }
    value->problem = Problem{"", text_position(source.text, position > 0 ? position - 1 : 0),
                             "half of a character, a lone surrogate", "\\u escapes in pairs"};
    return false;
  }

  GrowingValue* value = nullptr;
  SourceText source;
};

/// Reads a value, or finds the problem of the text.
std::optional<Problem> read(const SourceText& source, const JsonLimits& limits,
                            GrowingValue& value) {
  const std::string_view text = source.text;
  if (text.size() > limits.max_bytes) {
    return Problem{"", "", fmt::format("{} bytes", text.size()),
                   fmt::format("at most {}", limits.max_bytes)};
  }
  ParserEvents events;
  events.value = &value;
  events.source = source;
  json::sax_parse(text.begin(), text.end(), &events);
  // The parser takes a zero byte for the end, whatever follows.
  const auto zero = value.problem ? std::string_view::npos : text.find('\0');
  if (zero != std::string_view::npos) {
    return Problem{"", text_position(text, zero), "a zero byte", "text without zero bytes"};
  }
  return value.problem;
}

json own_value(std::string_view text, const std::string& what, StreamedList list) {
  GrowingValue value(kOwnJsonLimits, std::move(list));
  if (const auto problem = read({text}, kOwnJsonLimits, value)) {
    throw EnvironmentError(fmt::format("{} is damaged: {}", what, problem->text()));
  }
  return value.take();
}

}  // namespace

json parse_json(std::string_view text, const std::string& source, const JsonLimits& limits) {
  GrowingValue value(limits, {});
  if (auto problem = read({text, source.empty() ? "body" : "file"}, limits, value)) {
    problem->source = source;
    throw InputError(std::move(*problem));
  }
  return value.take();
}

json parse_own_json(std::string_view text, const std::string& what) {
  return own_value(text, what, {});
}

json parse_json_or_discard(std::string_view text, const JsonLimits& limits) {
  GrowingValue value(limits, {});
  return read({text}, limits, value) ? json(json::value_t::discarded) : value.take();
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
  return own_value(text, what, {list_key, on_element});
}

}  // namespace throng
