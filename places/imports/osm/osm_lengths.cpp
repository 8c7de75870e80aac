#include "places/imports/osm/osm_lengths.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <string>
#include <utility>

#include "base/text/words.h"

namespace throng::imports {

namespace {

constexpr double kInchM = 0.0254;
constexpr double kFootM = 12 * kInchM;
constexpr double kMaxLengthM = 1000;
constexpr double kMaxCount = 300;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Lower case, with one spelling of each sign.
std::string plain(std::string_view text) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 15> kSigns = {
      {{"\u2032", "'"},  // prime
       {"\u2018", "'"},
       {"\u2019", "'"},
       {"\u00b4", "'"},
       {"`", "'"},
       {"\u2033", "\""},  // double prime
       {"\u201c", "\""},
       {"\u201d", "\""},
       {"\u2013", "-"},
       {"\u2014", "-"},
       {"\u00a0", " "},
       {"\u202f", " "},
       {"\t", " "},
       {"\u2248", "~"},
       {"\u043c", "m"}}};  // Cyrillic
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    const auto sign = std::find_if(kSigns.begin(), kSigns.end(), [&](const auto& one) {
      return text.substr(at).starts_with(one.first);
    });
    if (sign != kSigns.end()) {
      result += sign->second;
      at += sign->first.size();
      continue;
    }
    const char c = text[at++];
    result += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  for (std::size_t at = result.find("''"); at != std::string::npos; at = result.find("''")) {
    result.replace(at, 2, "\"");
  }
  return result;
}

/// Removes the words by which mappers say that a value is rough.
std::string_view without_doubt(std::string_view text) {
  constexpr std::array<std::string_view, 10> kWords = {
      "~", "approximately", "approx.", "approx", "about", "around", "circa", "ca.", "ca", "c."};
  text = trimmed(text);
  for (const std::string_view word : kWords) {
    if (text.starts_with(word)) return trimmed(text.substr(word.size()));
  }
  return text;
}

/// Takes a number without a sign from the front of the text.
std::optional<double> take_number(std::string_view& text) {
  std::size_t end = 0;
  while (end < text.size() && is_digit(text[end])) ++end;
  const std::size_t whole = end;
  if (end + 1 < text.size() && (text[end] == '.' || text[end] == ',') && is_digit(text[end + 1])) {
    for (++end; end < text.size() && is_digit(text[end]);) ++end;
    constexpr std::size_t kOfThousands = 4;  // with the comma
    if (text[whole] == ',' && end - whole == kOfThousands) return std::nullopt;
  }
  if (whole == 0) return std::nullopt;
  std::string digits(text.substr(0, end));
  if (whole < end) digits[whole] = '.';
  double value = 0;
  const auto [rest, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc()) return std::nullopt;
  text.remove_prefix(end);
  return value;
}

/// Meters of a unit, or nothing.
std::optional<double> unit_m(std::string_view unit) {
  constexpr std::array<std::pair<std::string_view, double>, 26> kUnits = {
      {{"", 1},         {"m", 1},         {"meter", 1},       {"meters", 1},    {"metre", 1},
       {"metres", 1},   {"metro", 1},     {"metros", 1},      {"mtr", 1},       {"mtrs", 1},
       {"mts", 1},      {"mt", 1},        {"km", 1000},       {"cm", 0.01},     {"mm", 0.001},
       {"'", kFootM},   {"ft", kFootM},   {"feet", kFootM},   {"foot", kFootM}, {"\"", kInchM},
       {"in", kInchM},  {"inch", kInchM}, {"inches", kInchM}, {"yd", 0.9144},   {"yards", 0.9144},
       {"mi", 1609.344}}};
  if (unit.ends_with('.')) unit.remove_suffix(1);
  const auto found = std::find_if(kUnits.begin(), kUnits.end(),
                                  [&](const auto& one) { return one.first == unit; });
  if (found == kUnits.end()) return std::nullopt;
  return found->second;
}

/// Takes the unit of feet from the front of the text.
bool take_feet(std::string_view& text) {
  for (const std::string_view feet : {"'", "feet", "foot", "ft.", "ft"}) {
    if (!text.starts_with(feet)) continue;
    text = trimmed(text.substr(feet.size()));
    return true;
  }
  return false;
}

/// Reads one length: a number and its unit, or feet and inches.
std::optional<double> one_length(std::string_view text) {
  text = without_doubt(text);
  const auto value = take_number(text);
  if (!value) return std::nullopt;
  text = trimmed(text);
  if (const auto unit = unit_m(text)) return *value * *unit;
  if (!take_feet(text)) return std::nullopt;
  if (text.starts_with('-')) text = trimmed(text.substr(1));
  const auto inches = take_number(text);
  text = trimmed(text);
  const bool is_inch = text.empty() || unit_m(text) == kInchM;
  if (!inches || *inches >= 12 || !is_inch) return std::nullopt;
  return *value * kFootM + *inches * kInchM;
}

std::optional<double> one_count(std::string_view text) {
  constexpr std::array<std::string_view, 9> kWords = {
      "", "level", "levels", "floor", "floors", "storey", "storeys", "stories", "lanes"};
  text = without_doubt(text);
  const auto value = take_number(text);
  if (!value || std::find(kWords.begin(), kWords.end(), trimmed(text)) == kWords.end()) {
    return std::nullopt;
  }
  return value;
}

/// Reads one value, or the upper end of a range such as "8-12 m".
template <typename ReadOne>
std::optional<double> one_or_range(std::string_view text, const ReadOne& read_one) {
  if (const auto value = read_one(text)) return value;
  const std::size_t dash = text.find('-');
  if (dash == std::string_view::npos) return std::nullopt;
  std::string_view lower = without_doubt(text.substr(0, dash));
  std::string_view upper = without_doubt(text.substr(dash + 1));
  const std::string_view whole_upper = upper;
  const bool has_lower = read_one(lower).has_value();
  const auto from = take_number(lower);
  const auto to = take_number(upper);
  if (!has_lower || !from || !to || *to < *from) return std::nullopt;
  return read_one(whole_upper);
}

template <typename ReadOne>
std::optional<double> largest_in(std::string_view text, double most, const ReadOne& read_one) {
  const std::string words = plain(text);
  std::optional<double> largest;
  for (std::size_t at = 0; at <= words.size();) {
    const std::size_t end = std::min(words.find(';', at), words.size());
    const std::string_view one = trimmed(std::string_view(words).substr(at, end - at));
    at = end + 1;
    if (one.empty()) continue;
    const auto value = one_or_range(one, read_one);
    if (!value || *value > most) return std::nullopt;
    largest = std::max(largest.value_or(0), *value);
  }
  return largest;
}

}  // namespace

std::optional<double> length_in(std::string_view text) {
  return largest_in(text, kMaxLengthM, one_length);
}

std::optional<double> count_in(std::string_view text) {
  return largest_in(text, kMaxCount, one_count);
}

}  // namespace throng::imports
