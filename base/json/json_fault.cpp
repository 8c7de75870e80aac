#include "base/json/json_fault.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/text/utf8.h"
#include "base/text/words.h"

namespace throng {

namespace {

constexpr std::size_t kMaxShownCharacters = 30;

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool is_word(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return is_digit(c) || (byte >= 'a' && byte <= 'z') || (byte >= 'A' && byte <= 'Z') || c == '_' ||
         c == '.' || c == '+' || c == '-' || c == '$' || byte >= 0x80;
}

/// Takes the digits that the text begins with. Whether there are some.
bool take_digits(std::string_view& text) {
  const std::size_t count = std::min(text.find_first_not_of("0123456789"), text.size());
  text.remove_prefix(count);
  return count > 0;
}

bool take_one(std::string_view& text, std::string_view characters) {
  if (text.empty() || characters.find(text.front()) == std::string_view::npos) return false;
  text.remove_prefix(1);
  return true;
}

/// Whether the word is a number of JSON (RFC 8259, section 6).
bool is_number(std::string_view word) {
  take_one(word, "-");
  if (!take_one(word, "0") && !take_digits(word)) return false;
  if (take_one(word, ".") && !take_digits(word)) return false;
  if (take_one(word, "eE")) {
    take_one(word, "+-");
    if (!take_digits(word)) return false;
  }
  return word.empty();
}

/// Whether the text after a backslash is an escape of JSON.
bool is_escape(std::string_view text) {
  if (!take_one(text, "u")) return take_one(text, "\"\\/bfnrt");
  constexpr int kDigits = 4;
  for (int i = 0; i < kDigits; ++i) {
    if (!take_one(text, "0123456789abcdefABCDEF")) return false;
  }
  return true;
}

std::string shorten(std::string_view text, std::size_t count = kMaxShownCharacters) {
  const std::string start = first_characters(text, count);
  if (!is_utf8(start)) return "bytes that are not UTF-8";
  return start.size() < text.size() ? start + "..." : start;
}

struct Fault {
  std::size_t byte;
  std::string found;
  std::string expected;
};

/// An object or array that is open.
struct Bracket {
  char opened;
  std::size_t byte;
};

/// Reads the text as JSON until something is not. Holds no values, so that depth is no matter.
class FaultFinder {
 public:
  explicit FaultFinder(std::string_view text) : text_(text) {}

  std::optional<Fault> find() {
    while (!fault_) {
      skip_space();
      if (fault_ || !step()) break;
    }
    return fault_;
  }

 private:
  enum class Next { value, value_or_end, key, key_or_end, colon, comma_or_end, end };

  bool is_at_end() const { return at_ >= text_.size(); }
  bool sees(std::string_view start) const { return text_.substr(at_).starts_with(start); }
  bool wants_key() const { return next_ == Next::key || next_ == Next::key_or_end; }
  bool wants_value() const { return next_ == Next::value || next_ == Next::value_or_end; }

  void fail(std::size_t byte, std::string found, std::string expected) {
    if (!fault_) fault_ = Fault{byte, std::move(found), std::move(expected)};
  }

  void skip_space() {
    while (!is_at_end() && is_space(text_[at_])) ++at_;
    for (const std::string_view comment : {"//", "/*", "#"}) {
      if (sees(comment)) fail(at_, "a comment", "no comment: JSON has none");
    }
  }

  /// Reads what comes next. False at the end of the text, or at a fault.
  bool step() {
    if (is_at_end()) {
      at_end();
      return false;
    }
    if (next_ == Next::end) {
      fail(at_, "more text after the end of the value: " + shorten(line_from(at_)),
           "one value, and nothing after it");
      return false;
    }
    const char c = text_[at_];
    if (c == '}' || c == ']') {
      close(c);
    } else if (c == ',') {
      comma();
    } else if (c == ':' || c == '=') {
      colon(c);
    } else {
      token(c);
    }
    return !fault_;
  }

  void at_end() {
    if (!open_.empty()) {
      const Bracket& last = open_.back();
      fail(text_.size(),
           fmt::format("the end of the text, with the {} of {} still open", last.opened,
                       text_position(text_, last.byte)),
           fmt::format("{}", last.opened == '{' ? '}' : ']'));
    } else if (next_ != Next::end) {
      fail(text_.size(), "the end of the text", "a value");
    }
  }

  void close(char c) {
    if (open_.empty()) return fail(at_, fmt::format("a {} that closes nothing", c), "a value");
    const char wanted = open_.back().opened == '{' ? '}' : ']';
    if (c != wanted) {
      return fail(at_,
                  fmt::format("a {} that closes the {} of {}", c, open_.back().opened,
                              text_position(text_, open_.back().byte)),
                  fmt::format("{}", wanted));
    }
    if (next_ == Next::key || (next_ == Next::value && c == ']')) {
      return fail(comma_, fmt::format("a comma too many before {}", c),
                  "no comma after the last one");
    }
    if (next_ == Next::value) return fail(at_, "no value after the colon", "a value");
    if (next_ == Next::colon) return no_colon();
    open_.pop_back();
    ++at_;
    after_value();
  }

  void comma() {
    if (next_ == Next::comma_or_end) {
      comma_ = at_++;
      last_ = ',';
      next_ = open_.back().opened == '{' ? Next::key : Next::value;
      return;
    }
    if (next_ == Next::colon) return no_colon();
    const bool is_second = next_ == Next::key || (next_ == Next::value && last_ == ',');
    fail(at_, is_second ? "a second comma" : "a comma without a value before it",
         is_second ? "one comma" : "a value");
  }

  void colon(char c) {
    if (next_ == Next::colon && c == ':') {
      ++at_;
      next_ = Next::value;
      last_ = ':';
      return;
    }
    if (next_ == Next::colon) return fail(at_, "=", "a colon");
    fail(at_, fmt::format("a {} without a name in double quotes before it", c),
         wants_key() ? "a name in double quotes" : "a comma or a closing bracket");
  }

  void no_colon() {
    fail(value_end_, fmt::format("no colon after {}", shorten(last_text_)), "a colon and a value");
  }

  /// A text, number, word or opening bracket.
  void token(char c) {
    if (next_ == Next::colon) return no_colon();
    if (next_ == Next::comma_or_end) {
      return fail(value_end_, "no comma between this value and the next", "a comma");
    }
    if (c == '"') {
      read_text();
    } else if (c == '\'' || c == '`') {
      fail(at_, "a text in other quotes: " + shorten(word_from(at_)), "double quotes: \"");
    } else if (sees("\xe2\x80\x9c") || sees("\xe2\x80\x9d") || sees("\xe2\x80\x9e")) {
      fail(at_, "typographic quotes: " + shorten(word_from(at_)), "plain double quotes: \"");
    } else if (wants_key()) {
      fail(at_, fmt::format("{} where a field's name is due", shorten(word_from(at_))),
           "a name in double quotes");
    } else if (c == '{' || c == '[') {
      open_.push_back({c, at_++});
      next_ = c == '{' ? Next::key_or_end : Next::value_or_end;
      last_ = c;
    } else {
      read_word();
    }
  }

  void after_value() {
    value_end_ = at_;
    next_ = open_.empty() ? Next::end : Next::comma_or_end;
    last_ = 'v';
  }

  void read_text() {
    const std::size_t start = at_++;
    while (!is_at_end() && text_[at_] != '"') {
      if (text_[at_] == '\n' || text_[at_] == '\r') break;
      check_character();
      if (fault_) return;
      ++at_;
    }
    if (is_at_end() || text_[at_] != '"') {
      return fail(start, "a text without its closing quote: " + shorten(line_from(start)),
                  "a \" at its end");
    }
    ++at_;
    const std::string_view text = text_.substr(start, at_ - start);
    check_encoding(start, text);
    last_text_ = text;
    if (!wants_key()) return after_value();
    value_end_ = at_;
    next_ = Next::colon;
  }

  /// Checks the character of a text at `at_`; an escape's second character is skipped.
  void check_character() {
    const auto byte = static_cast<unsigned char>(text_[at_]);
    constexpr unsigned char kFirstPrinted = 0x20;
    if (byte == '\t') return fail(at_, "a tab inside of a text", "\\t");
    if (byte < kFirstPrinted) {
      return fail(at_, fmt::format("the control character {:#04x} inside of a text", byte),
                  fmt::format("\\u{:04x}", byte));
    }
    if (byte != '\\' || at_ + 1 >= text_.size()) return;
    if (!is_escape(text_.substr(at_ + 1))) {
      return fail(at_, "the unknown escape " + shorten(text_.substr(at_, 2)),
                  R"(\\ for a backslash)");
    }
    ++at_;
  }

  void check_encoding(std::size_t start, std::string_view text) {
    if (!is_utf8(text)) fail(start, "a text with bytes that are not UTF-8", "a file in UTF-8");
  }

  void read_word() {
    const std::string_view word = word_from(at_);
    const bool is_value = word == "true" || word == "false" || word == "null" || is_number(word);
    if (!is_value) return fail(at_, shorten(word), meant_by(word));
    at_ += word.size();
    after_value();
  }

  /// The word of JSON that is meant, or the form that is expected.
  static std::string meant_by(std::string_view word) {
    const std::string small = lower_case(word);
    if (small == "true" || small == "false" || small == "null") return small;
    if (small == "none" || small == "nil" || small == "undefined") return "null";
    if (small == "yes" || small == "on") return "true";
    if (small == "no" || small == "off") return "false";
    const std::size_t sign = small.find_first_not_of("+-");
    const std::string bare = sign == std::string::npos ? "" : small.substr(sign);
    if (bare == "nan" || bare == "inf" || bare == "infinity") {
      return "a number: JSON has neither NaN nor Infinity";
    }
    const bool is_like_number = !bare.empty() && (is_digit(bare[0]) || bare[0] == '.');
    if (!is_like_number) return "a value; texts are in double quotes";
    return "a number as 12, -0.5 or 1e3: no +, no leading 0, digits before and after the point";
  }

  std::string_view word_from(std::size_t start) const {
    std::size_t end = start;
    while (end < text_.size() && is_word(text_[end])) ++end;
    if (end > start) return text_.substr(start, end - start);
    while (end < text_.size() && !is_space(text_[end]) && text_[end] != ',') ++end;
    return text_.substr(start, end - start);
  }

  std::string_view line_from(std::size_t start) const {
    return text_.substr(start, text_.find_first_of("\r\n", start) - start);
  }

  std::string_view text_;
  std::size_t at_ = 0;
  Next next_ = Next::value;
  char last_ = 0;               ///< what was read last: a bracket, ',', ':' or 'v' for a value
  std::size_t comma_ = 0;       ///< the last comma
  std::size_t value_end_ = 0;   ///< of the last value or name
  std::string_view last_text_;  ///< in its quotes
  std::vector<Bracket> open_;
  std::optional<Fault> fault_;
};

/// The encoding that the first bytes are of, or an empty text for UTF-8.
std::string_view other_encoding(std::string_view text) {
  const std::string_view start = text.substr(0, 2);
  if (start == "\xff\xfe" || start == "\xfe\xff") return "UTF-16";
  constexpr std::string_view kNul("\0", 1);
  if (start.size() == 2 && (start.starts_with(kNul) || start.ends_with(kNul))) return "UTF-16";
  if (start == "\x1f\x8b") return "gzip";
  if (start == "PK") return "zip";
  return {};
}

}  // namespace

std::string text_position(std::string_view text, std::size_t byte) {
  const std::string_view before = text.substr(0, std::min(byte, text.size()));
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const std::size_t line_start = before.rfind('\n') + 1;  // npos + 1 = 0: the first line
  return fmt::format("line {}, column {}", line, character_count(before.substr(line_start)) + 1);
}

Problem json_fault(std::string_view text, std::string_view what) {
  constexpr std::string_view kMark = "\xef\xbb\xbf";  // of UTF-8, which the parser skips
  if (text.starts_with(kMark)) text.remove_prefix(kMark.size());
  if (std::all_of(text.begin(), text.end(), is_space)) {
    return {"", "", fmt::format("an empty {}", what), "valid JSON"};
  }
  if (const std::string_view encoding = other_encoding(text); !encoding.empty()) {
    return {"", "", fmt::format("a {} in {}", what, encoding), "valid JSON in UTF-8"};
  }
  const std::optional<Fault> fault = FaultFinder(text).find();
  if (!fault) return {};
  return {"", text_position(text, fault->byte), fault->found, fault->expected};
}

}  // namespace throng
