#include "metrics/trajectories/comment_units.h"

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

#include "metrics/trajectories/number_in.h"

namespace throng::metrics {

namespace {

struct Word {
  std::string_view text;
  char before = 0;       ///< the last character before it that is no blank
  char after = 0;        ///< the first one behind it
  bool touches = false;  ///< `after` follows without a blank
};

enum class Subject : std::uint8_t { none, position, other };

bool is_small_letter(char c) { return c >= 'a' && c <= 'z'; }

/// Words of letters, and numbers.
std::vector<Word> split_words(std::string_view text) {
  std::vector<Word> words;
  const auto is_number = [](char c) { return (c >= '0' && c <= '9') || c == '.'; };
  for (std::size_t at = 0; at < text.size();) {
    const bool letters = is_small_letter(text[at]);
    if (!letters && !(is_number(text[at]) && text[at] != '.')) {
      ++at;
      continue;
    }
    std::size_t end = at;
    while (end < text.size() && (letters ? is_small_letter(text[end]) : is_number(text[end])))
      ++end;
    const std::size_t before = text.find_last_not_of(" \t", at == 0 ? 0 : at - 1);
    const std::size_t after = text.find_first_not_of(" \t\r", end);
    words.push_back({text.substr(at, end - at),
                     at == 0 || before == std::string_view::npos ? '\0' : text[before],
                     after == std::string_view::npos ? '\0' : text[after], after == end});
    at = end;
  }
  return words;
}

bool starts_with_any(std::string_view word, std::initializer_list<std::string_view> starts) {
  return std::any_of(starts.begin(), starts.end(),
                     [&](std::string_view start) { return word.starts_with(start); });
}

bool is_any(std::string_view word, std::initializer_list<std::string_view> words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// "unit" by itself or at the end of a name, "lengthUnit"; also in German.
bool is_key(std::string_view word) {
  return word.ends_with("unit") || word.ends_with("units") || word.starts_with("einheit");
}

class CommentUnits {
 public:
  explicit CommentUnits(std::string_view text) : words_(split_words(text)) {
    has_key_ = std::any_of(words_.begin(), words_.end(), [](auto w) { return is_key(w.text); });
  }

  std::optional<Unit> find() {
    std::optional<Unit> early;  // before it is said what is in this unit
    for (std::size_t i = 0; i < words_.size(); ++i) {
      if (is_any(std::string_view(&words_[i].before, 1), {".", ";"})) subject_ = Subject::none;
      const Subject named = subject_named(i);
      if (named == Subject::position && early) return early;
      if (named != Subject::none) subject_ = named;
      if (subject_ == Subject::other) continue;
      Unit unit = unit_of_word(words_[i].text);
      if (is_unknown(i, unit)) return unit;
      if (!unit.is_of_positions() || !is_mention(i, unit)) continue;
      unit.factor *= number_before(i);
      if (subject_ == Subject::position) return unit;
      if (!early) early = unit;
      if (i + 1 == words_.size()) return early;
    }
    return std::nullopt;
  }

 private:
  Subject subject_named(std::size_t i) const {
    const std::string_view word = words_[i].text;
    const bool is_product =
        word == "x" && words_[i].before >= '0' && words_[i].before <= '9';  // "1920 x 1080 px"
    if (is_product) return Subject::none;
    // "Length in cm" is that of all, "corridor length in cm" is not.
    if (is_any(word, {"length", "distance"})) {
      return has_key_ || i == 0 ? Subject::position : Subject::other;
    }
    if (starts_with_any(word,
                        {"height", "width", "wide",     "radi",     "diameter", "size",     "age",
                         "speed",  "veloc", "accel",    "time",     "angle",    "orient",   "yaw",
                         "weight", "mass",  "altitude", "duration", "area",     "dimension"})) {
      return Subject::other;
    }
    const bool is_position =
        is_any(word, {"x", "y", "xy", "xyz", "lengths", "distances", "pos", "values", "data"}) ||
        (is_key(word) && subject_ != Subject::other) ||
        starts_with_any(word, {"coord", "position", "location", "trajector", "place"});
    return is_position ? Subject::position : Subject::none;
  }

  /// The word before, other than kinds of units ("US survey feet") and numbers; empty at the start.
  std::string_view previous(std::size_t i, bool also_articles) const {
    while (i > 0) {
      const std::string_view word = words_[--i].text;
      const bool is_kind = is_any(word, {"us", "survey", "international", "imperial", "statute",
                                         "image", "camera", "screen", "full", "whole"}) ||
                           (also_articles && is_any(word, {"the", "s", "its"}));
      if (!is_kind && !number_in(word)) return word;
    }
    return {};
  }

  /// Whether the word answers "unit:", "unit of length =" or "length unit".
  bool follows_key(std::size_t i, bool needs_sign) const {
    if (i > 0 && number_in(words_[i - 1].text)) --i;
    const bool sign = is_any(std::string_view(&words_[i].before, 1), {":", "="});
    constexpr std::size_t kFar = 4;  // "unit of length is in"
    for (std::size_t back = 1; back <= std::min(kFar, i); ++back) {
      const std::string_view word = words_[i - back].text;
      if (is_key(word)) return sign || !needs_sign;
      if (!is_any(word, {"of",  "length", "lengths",     "distance",  "is",          "are", "in",
                         "the", "for",    "all",         "measure",   "measurement", "x",   "y",
                         "z",   "and",    "coordinates", "positions", "position",    "axes"})) {
        return false;
      }
    }
    return false;
  }

  bool is_unknown(std::size_t i, const Unit& unit) const {
    return unit.kind == Unit::Kind::unknown && follows_key(i, true) && !number_in(words_[i].text) &&
           !is_key(words_[i].text) &&
           !is_any(words_[i].text,
                   {"see",      "as",       "the",       "of",          "is",     "none",
                    "unknown",  "us",       "x",         "y",           "z",      "length",
                    "lengths",  "position", "positions", "coordinates", "survey", "international",
                    "imperial", "statute",  "all",       "image",       "both"});
  }

  bool is_mention(std::size_t i, const Unit& unit) const {
    const Word& word = words_[i];
    if (words_.size() == 1) return true;
    if (word.after == '/' || (word.touches && word.after == '^')) {
      return false;  // of a speed or an area
    }
    const bool has_next = i + 1 < words_.size();
    const bool is_pixel = unit.kind == Unit::Kind::pixels;
    // "In the yard" is a place, "in the camera's pixels" is none.
    const std::string_view before = previous(i, is_pixel);
    const bool is_bracketed =
        (word.before == '[' || word.before == '(') && !is_small_letter(word.after);
    const bool is_value = word.before == ':' || word.before == '=';
    if (word.text == "in" && before != "in" && is_small_letter(word.after)) return false;
    if (is_bracketed || before == "in") return true;
    if (is_pixel && has_next && is_small_letter(word.after) &&
        starts_with_any(words_[i + 1].text, {"coord", "position", "unit", "space"})) {
      return true;
    }
    if (word.text == "in" && !is_value) return false;
    if (follows_key(i, false) || (has_next && is_key(words_[i + 1].text))) return true;
    // "Positions: feet" may be where somebody's feet are.
    const bool is_body = starts_with_any(word.text, {"foot", "feet"});
    if (is_value && (is_any(before, {"x", "y", "z", "lengths", "distances", "values", "system"}) ||
                     starts_with_any(before, {"coord", "position", "location"}))) {
      return !is_body || is_any(before, {"x", "y", "z"});
    }
    return before == "are" && subject_ == Subject::position;
  }

  double number_before(std::size_t i) const {
    if (i == 0 || !follows_key(i, true)) return 1;
    const auto number = number_in(words_[i - 1].text);
    return number && *number > 0 ? *number : 1;
  }

  std::vector<Word> words_;
  Subject subject_ = Subject::none;
  bool has_key_ = false;
};

}  // namespace

std::optional<Unit> unit_in_comment(std::string_view comment) {
  const std::string text = normalized_words(comment);
  return CommentUnits(text).find();
}

}  // namespace throng::metrics
