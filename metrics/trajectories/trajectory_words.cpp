#include "metrics/trajectories/trajectory_words.h"
#include "base/text/words.h"

#include <array>
#include <charconv>
#include <cmath>
#include <system_error>
#include <utility>

namespace throng::metrics {

namespace {

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

// The text with a point for a comma between the digits at its beginning.
std::string with_decimal_point(std::string_view text) {
  std::string copy(text);
  std::size_t at = 0;
  while (at < copy.size() && is_digit(copy[at])) ++at;
  if (at + 1 < copy.size() && copy[at] == ',' && is_digit(copy[at + 1])) copy[at] = '.';
  return copy;
}

// The first number from a place on that is not part of a word, unless "fps" ends that.
std::optional<double> rate_from(std::string_view text, std::size_t at) {
  for (; at < text.size(); ++at) {
    const bool inside = at > 0 && (is_letter(text[at - 1]) || is_digit(text[at - 1]) ||
                                   text[at - 1] == '_' || text[at - 1] == '.');
    if (!is_digit(text[at]) || inside) continue;
    const std::string number = with_decimal_point(text.substr(at));
    double rate = 0;
    const auto [rest, error] = std::from_chars(number.data(), number.data() + number.size(), rate);
    const std::string_view unit(rest,
                                static_cast<std::size_t>(number.data() + number.size() - rest));
    const bool ends = unit.empty() || !(is_letter(unit.front()) || unit.front() == '_');
    const bool fps =
        unit.starts_with("fps") && (unit.size() == 3 || (!is_letter(unit[3]) && unit[3] != '_'));
    if (error == std::errc() && rate > 0 && std::isfinite(rate) && (ends || fps)) return rate;
  }
  return std::nullopt;
}

}  // namespace

std::optional<double> frame_rate_in(std::string_view comment) {
  const std::string lower = lower_case(comment);
  for (const std::string_view mark :
       {"framerate", "frame rate", "frame_rate", "frames per second"}) {
    if (const std::size_t at = lower.find(mark); at != std::string::npos) {
      if (const auto rate = rate_from(lower, at + mark.size())) return rate;
    }
  }
  if (lower.find("fps") == std::string::npos) return std::nullopt;
  return rate_from(lower, 0);
}

std::optional<double> unit_in(std::string_view text) {
  constexpr std::array<std::pair<std::string_view, double>, 3> kUnits = {
      {{"cm", 0.01}, {"mm", 0.001}, {"m", 1}}};
  const std::string lower = lower_case(text);
  // Heights, too, are in something.
  bool speaks_of_positions = false;
  for (const std::string_view word : {"unit", "coordinate", "position", "length", "x,", "x and"}) {
    speaks_of_positions |= lower.find(word) != std::string::npos;
  }
  for (const auto& [unit, meters] : kUnits) {
    for (const std::string_view before : {"x/", "x [", "x[", "x (", "x(", "in "}) {
      if (before == "in " && !speaks_of_positions) continue;
      const std::string words = std::string(before) + std::string(unit);
      const std::size_t at = lower.find(words);
      if (at == std::string::npos) continue;
      const std::size_t end = at + words.size();
      if (end == lower.size() || !is_letter(lower[end])) return meters;
    }
  }
  return std::nullopt;
}

std::optional<double> unit_of_word(std::string_view word) {
  constexpr std::array<std::pair<std::string_view, double>, 18> kWords = {{{"m", 1},
                                                                           {"meter", 1},
                                                                           {"meters", 1},
                                                                           {"metre", 1},
                                                                           {"metres", 1},
                                                                           {"cm", 0.01},
                                                                           {"centimeter", 0.01},
                                                                           {"centimeters", 0.01},
                                                                           {"centimetre", 0.01},
                                                                           {"centimetres", 0.01},
                                                                           {"mm", 0.001},
                                                                           {"millimeter", 0.001},
                                                                           {"millimeters", 0.001},
                                                                           {"ft", 0.3048},
                                                                           {"feet", 0.3048},
                                                                           {"foot", 0.3048},
                                                                           {"km", 1000},
                                                                           {"in", 0.0254}}};
  const std::string lower = lower_case(trimmed(word, " []()\""));
  for (const auto& [known, meters] : kWords) {
    if (lower == known) return meters;
  }
  return std::nullopt;
}

std::optional<double> unit_in_name(std::string_view name) {
  const std::size_t at = name.find_last_of("_/[( ");
  return at == std::string_view::npos ? std::nullopt : unit_of_word(name.substr(at + 1));
}

std::optional<double> last_unit_in(std::string_view text) {
  const std::size_t end = text.rfind(']');
  const std::size_t start = text.rfind('[', end);
  if (end == std::string_view::npos || start == std::string_view::npos) return std::nullopt;
  return unit_of_word(text.substr(start, end - start));
}

std::optional<double> time_unit_in(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, double>, 8> kWords = {{{"s", 1},
                                                                          {"sec", 1},
                                                                          {"ms", 1e-3},
                                                                          {"us", 1e-6},
                                                                          {"\u00b5s", 1e-6},
                                                                          {"ns", 1e-9},
                                                                          {"min", 60},
                                                                          {"h", 3600}}};
  const std::size_t at = name.find_last_of("_/[( ");
  const std::string lower =
      lower_case(trimmed(at == std::string_view::npos ? name : name.substr(at + 1), " []()\""));
  for (const auto& [known, seconds] : kWords) {
    if (lower == known) return seconds;
  }
  return std::nullopt;
}

std::string bare_name(std::string_view name) {
  std::string bare;
  name = name.substr(0, name.find("-PID"));
  for (const char c : lower_case(name.substr(0, name.find_first_of("/[(")))) {
    if (is_letter(c) || is_digit(c)) bare += c;
  }
  return bare;
}

}  // namespace throng::metrics
