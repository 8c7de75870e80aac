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

using PossibleFault = std::optional<Fault>;

/// An object or array that is open.
struct Bracket {
  char opened;
  std::size_t byte;

  char closing() const { return opened == '{' ? '}' : ']'; }
};

enum class Next { value, value_or_end, key, key_or_end, colon, comma_or_end, end };

std::string_view word_at(std::string_view text, std::size_t start) {
  std::size_t end = start;
  while (end < text.size() && is_word(text[end])) ++end;
  if (end > start) return text.substr(start, end - start);
  while (end < text.size() && !is_space(text[end]) && text[end] != ',') ++end;
  return text.substr(start, end - start);
}

std::string_view rest_of_line(std::string_view text, std::size_t start) {
  return text.substr(start, text.find_first_of("\r\n", start) - start);
}

/// The word of JSON that is meant, or the form that is expected.
std::string meant_by(std::string_view word) {
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

/// The fault of a character inside of a text, without the byte.
PossibleFault character_fault(std::string_view from_character) {
  const auto byte = static_cast<unsigned char>(from_character.front());
  constexpr unsigned char kFirstPrinted = 0x20;
  if (byte == '\t') return Fault{0, "a tab inside of a text", "\\t"};
  if (byte < kFirstPrinted) {
    return Fault{0, fmt::format("the control character {:#04x} inside of a text", byte),
                 fmt::format("\\u{:04x}", byte)};
  }
  if (byte != '\\' || from_character.size() < 2 || is_escape(from_character.substr(1))) return {};
  return Fault{0, "the unknown escape " + shorten(from_character.substr(0, 2)),
               R"(\\ for a backslash)"};
}

/// Reads a text from its opening quote at `at`, which moves behind the closing quote.
PossibleFault read_text(std::string_view text, std::size_t& at) {
  const std::size_t start = at++;
  const auto is_inside = [&] {
    return at < text.size() && text[at] != '"' && text[at] != '\n' && text[at] != '\r';
  };
  for (; is_inside(); ++at) {
    if (PossibleFault fault = character_fault(text.substr(at))) {
      fault->byte = at;
      return fault;
    }
    if (text[at] == '\\' && at + 1 < text.size()) ++at;  // the escape's second character
  }
  if (at >= text.size() || text[at] != '"') {
    return Fault{start, "a text without its closing quote: " + shorten(rest_of_line(text, start)),
                 "a \" at its end"};
  }
  ++at;
  if (is_utf8(text.substr(start, at - start))) return {};
  return Fault{start, "a text with bytes that are not UTF-8", "a file in UTF-8"};
}

/// The fault of a comment, or of quotes that are not those of JSON, at a byte.
PossibleFault comment_fault(std::string_view text, std::size_t at) {
  for (const std::string_view comment : {"//", "/*", "#"}) {
    if (text.substr(at).starts_with(comment)) {
      return Fault{at, "a comment", "no comment: JSON has none"};
    }
  }
  return {};
}
PossibleFault quote_fault(std::string_view text, std::size_t at) {
  if (text[at] == '\'' || text[at] == '`') {
    return Fault{at, "a text in other quotes: " + shorten(word_at(text, at)), "double quotes: \""};
  }
  for (const std::string_view quote : {"\xe2\x80\x9c", "\xe2\x80\x9d", "\xe2\x80\x9e"}) {
    if (text.substr(at).starts_with(quote)) {
      return Fault{at, "typographic quotes: " + shorten(word_at(text, at)),
                   "plain double quotes: \""};
    }
  }
  return {};
}

/// The fault of a text that ends while something else is expected.
PossibleFault end_fault(std::string_view text, const std::vector<Bracket>& open, Next next) {
  if (!open.empty()) {
    const Bracket& last = open.back();
    return Fault{text.size(),
                 fmt::format("the end of the text, with the {} of {} still open", last.opened,
                             text_position(text, last.byte)),
                 std::string(1, last.closing())};
  }
  if (next == Next::end) return {};
  return Fault{text.size(), "the end of the text", "a value"};
}

/// Reads the text as JSON until something is not. Holds no values, so that depth is no matter.
class FaultFinder {
 public:
  explicit FaultFinder(std::string_view text) : text_(text) {}

  PossibleFault find() {
    for (;;) {
      while (at_ < text_.size() && is_space(text_[at_])) ++at_;
      if (at_ >= text_.size()) return end_fault(text_, open_, next_);
      const char c = text_[at_];
      PossibleFault fault = comment_fault(text_, at_);
      if (fault) return fault;
      if (next_ == Next::end) {
        return Fault{at_,
                     "more text after the end of the value: " + shorten(rest_of_line(text_, at_)),
                     "one value, and nothing after it"};
      }
      if (c == '}' || c == ']') {
        fault = close(c);
      } else if (c == ',') {
        fault = comma();
      } else if (c == ':' || c == '=') {
        fault = colon(c);
      } else {
        fault = token(c);
      }
      if (fault) return fault;
    }
  }

 private:
  PossibleFault close(char c) {
    if (open_.empty()) return Fault{at_, fmt::format("a {} that closes nothing", c), "a value"};
    const Bracket& last = open_.back();
    if (c != last.closing()) {
      return Fault{at_,
                   fmt::format("a {} that closes the {} of {}", c, last.opened,
                               text_position(text_, last.byte)),
                   std::string(1, last.closing())};
    }
    if (next_ == Next::key || (next_ == Next::value && c == ']')) {
      return Fault{comma_, fmt::format("a comma too many before {}", c),
                   "no comma after the last one"};
    }
    if (next_ == Next::value) return Fault{at_, "no value after the colon", "a value"};
    if (next_ == Next::colon) return no_colon();
    open_.pop_back();
    ++at_;
    return after_value();
  }

  PossibleFault comma() {
    if (next_ == Next::comma_or_end) {
      comma_ = at_++;
      next_ = open_.back().opened == '{' ? Next::key : Next::value;
      return {};
    }
    if (next_ == Next::colon) return no_colon();
    const bool is_second =
        next_ == Next::key || (next_ == Next::value && comma_ > 0 && comma_ >= value_end_);
    return Fault{at_, is_second ? "a second comma" : "a comma without a value before it",
                 is_second ? "one comma" : "a value"};
  }

  PossibleFault colon(char c) {
    if (next_ == Next::colon && c == ':') {
      ++at_;
      next_ = Next::value;
      return {};
    }
    if (next_ == Next::colon) return Fault{at_, "=", "a colon"};
    const bool wants_key = next_ == Next::key || next_ == Next::key_or_end;
    return Fault{at_, fmt::format("a {} without a name in double quotes before it", c),
                 wants_key ? "a name in double quotes" : "a comma or a closing bracket"};
  }

  PossibleFault no_colon() const {
    return Fault{value_end_, fmt::format("no colon after {}", shorten(last_text_)),
                 "a colon and a value"};
  }

  /// A text, number, word or opening bracket.
  PossibleFault token(char c) {
    if (next_ == Next::colon) return no_colon();
    if (next_ == Next::comma_or_end) {
      return Fault{value_end_, "no comma between this value and the next", "a comma"};
    }
    const bool wants_key = next_ == Next::key || next_ == Next::key_or_end;
    if (c == '"') {
      const std::size_t start = at_;
      if (PossibleFault fault = read_text(text_, at_)) return fault;
      last_text_ = text_.substr(start, at_ - start);
      if (!wants_key) return after_value();
      value_end_ = at_;
      next_ = Next::colon;
      return {};
    }
    if (PossibleFault fault = quote_fault(text_, at_)) return fault;
    const std::string_view word = word_at(text_, at_);
    if (wants_key) {
      return Fault{at_, fmt::format("{} where a field's name is due", shorten(word)),
                   "a name in double quotes"};
    }
    if (c == '{' || c == '[') {
      open_.push_back({c, at_++});
      next_ = c == '{' ? Next::key_or_end : Next::value_or_end;
      return {};
    }
    const bool is_value = word == "true" || word == "false" || word == "null" || is_number(word);
    if (!is_value) return Fault{at_, shorten(word), meant_by(word)};
    at_ += word.size();
    return after_value();
  }

  PossibleFault after_value() {
    value_end_ = at_;
    next_ = open_.empty() ? Next::end : Next::comma_or_end;
    return {};
  }

  std::string_view text_;
  std::size_t at_ = 0;
  Next next_ = Next::value;
  std::size_t comma_ = 0;       ///< the last comma
  std::size_t value_end_ = 0;   ///< of the last value or name
  std::string_view last_text_;  ///< in its quotes
  std::vector<Bracket> open_;
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
  const PossibleFault fault = FaultFinder(text).find();
  if (!fault) return {};
  return {"", text_position(text, fault->byte), fault->found, fault->expected};
}

}  // namespace throng
