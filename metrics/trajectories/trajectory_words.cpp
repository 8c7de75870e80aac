#include "metrics/trajectories/trajectory_words.h"

#include <charconv>
#include <cmath>
#include <system_error>
#include <utility>

#include "base/text/words.h"
#include "metrics/trajectories/unit_words.h"

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

std::string bare_name(std::string_view name) {
  std::string bare;
  name = name.substr(0, name.find("-PID"));
  for (const char c : normalized_words(name.substr(0, name.find_first_of("/[(")))) {
    if (is_letter(c) || is_digit(c)) bare += c;
  }
  return bare;
}

}  // namespace throng::metrics
