#include "metrics/trajectories/unit_words.h"

#include <algorithm>
#include <array>

#include "base/text/words.h"
#include "metrics/trajectories/recorded.h"

namespace throng::metrics {

namespace {

using Kind = Unit::Kind;

struct KnownWord {
  std::string_view word;
  Kind kind;
  double factor;
};

constexpr std::array kWords = {KnownWord{"m", Kind::length, 1},
                               KnownWord{"metric", Kind::length, 1},
                               KnownWord{"si", Kind::length, 1},
                               KnownWord{"cm", Kind::length, 0.01},
                               KnownWord{"mm", Kind::length, 0.001},
                               KnownWord{"dm", Kind::length, 0.1},
                               KnownWord{"km", Kind::length, 1000},
                               KnownWord{"um", Kind::length, 1e-6},
                               KnownWord{"micron", Kind::length, 1e-6},
                               KnownWord{"ft", Kind::length, 0.3048},
                               KnownWord{"foot", Kind::length, 0.3048},
                               KnownWord{"feet", Kind::length, 0.3048},
                               KnownWord{"in", Kind::length, 0.0254},
                               KnownWord{"inch", Kind::length, 0.0254},
                               KnownWord{"inche", Kind::length, 0.0254},
                               KnownWord{"yd", Kind::length, 0.9144},
                               KnownWord{"yard", Kind::length, 0.9144},
                               KnownWord{"mi", Kind::length, 1609.344},
                               KnownWord{"mile", Kind::length, 1609.344},
                               KnownWord{"s", Kind::time, 1},
                               KnownWord{"sec", Kind::time, 1},
                               KnownWord{"second", Kind::time, 1},
                               KnownWord{"ms", Kind::time, 1e-3},
                               KnownWord{"msec", Kind::time, 1e-3},
                               KnownWord{"millisecond", Kind::time, 1e-3},
                               KnownWord{"us", Kind::time, 1e-6},
                               KnownWord{"usec", Kind::time, 1e-6},
                               KnownWord{"microsecond", Kind::time, 1e-6},
                               KnownWord{"ns", Kind::time, 1e-9},
                               KnownWord{"nanosecond", Kind::time, 1e-9},
                               KnownWord{"min", Kind::time, 60},
                               KnownWord{"minute", Kind::time, 60},
                               KnownWord{"h", Kind::time, 3600},
                               KnownWord{"hr", Kind::time, 3600},
                               KnownWord{"hour", Kind::time, 3600},
                               KnownWord{"frame", Kind::frames, 1},
                               KnownWord{"px", Kind::pixels, 1},
                               KnownWord{"pix", Kind::pixels, 1},
                               KnownWord{"pixel", Kind::pixels, 1}};

constexpr std::array<std::pair<std::string_view, double>, 6> kPrefixes = {
    {{"kilo", 1000}, {"deci", 0.1}, {"centi", 0.01}, {"milli", 0.001}, {"micro", 1e-6}, {"", 1}}};

std::optional<KnownWord> known(std::string_view singular) {
  for (const KnownWord& word : kWords) {
    if (word.word == singular) return word;
  }
  for (const auto& [prefix, factor] : kPrefixes) {
    if (!singular.starts_with(prefix)) continue;
    const std::string_view rest = singular.substr(prefix.size());
    if (rest == "meter" || rest == "metre") return KnownWord{singular, Kind::length, factor};
  }
  return std::nullopt;
}

/// The text in the last pair of these brackets, if there is one.
std::optional<std::string_view> bracketed(std::string_view text, char open, char close) {
  const std::size_t end = text.rfind(close);
  const std::size_t start = text.rfind(open, end);
  if (end == std::string_view::npos || start == std::string_view::npos) return std::nullopt;
  return text.substr(start + 1, end - start - 1);
}

/// The unit of a text in brackets or behind a slash; nothing if it is empty, a dash or the word of
/// a direction or of a frame of reference.
std::optional<Unit> explicit_unit(std::string_view text) {
  constexpr std::array<std::string_view, 9> kAxes = {"-",     "east",  "north",  "right",  "left",
                                                     "world", "local", "global", "forward"};
  std::string_view word = trimmed(text, " []()\"");
  const std::string lower = lower_case(word);
  if (word.empty() || std::find(kAxes.begin(), kAxes.end(), lower) != kAxes.end()) {
    return std::nullopt;
  }
  if (lower.starts_with("in ")) word.remove_prefix(3);
  return unit_of_word(word);
}

}  // namespace

std::string normalized_words(std::string_view text) {
  std::string words(text);
  for (const std::string_view micro : {"\u00b5", "\u03bc"}) {
    for (std::size_t at = words.find(micro); at != std::string::npos; at = words.find(micro)) {
      words.replace(at, micro.size(), "u");
    }
  }
  return lower_case(words);
}

Unit unit_of_word(std::string_view word) {
  const std::string lower = normalized_words(trimmed(word, " []()\"."));
  auto found = known(lower);
  if (!found && lower.ends_with('s')) found = known(lower.substr(0, lower.size() - 1));
  Unit unit{.word = std::string(word)};
  if (found) {
    unit.kind = found->kind;
    unit.factor = found->factor;
  }
  return unit;
}

std::optional<Unit> unit_in_name(std::string_view name) {
  for (const auto& [open, close] : {std::pair('[', ']'), std::pair('(', ')')}) {
    const auto inside = bracketed(name, open, close);
    if (!inside) continue;
    if (auto unit = explicit_unit(*inside)) return unit;
    name = trimmed(name.substr(0, name.rfind(open)), " ");
  }
  if (const std::size_t slash = name.rfind('/'); slash != std::string_view::npos) {
    return explicit_unit(name.substr(slash + 1));
  }
  const std::size_t at = name.find_last_of("_ .-");
  if (at == std::string_view::npos) return std::nullopt;
  const Unit unit = unit_of_word(name.substr(at + 1));
  return unit.kind == Kind::unknown ? std::nullopt : std::optional(unit);
}

std::optional<Unit> last_unit_in(std::string_view text) {
  const auto inside = bracketed(text, '[', ']');
  return inside ? explicit_unit(*inside) : std::nullopt;
}

std::string expected_unit(const Unit& unit) {
  if (unit.kind != Kind::pixels) {
    return std::string("m, dm, cm, mm, km, feet, inches, yards or miles; or ") + kUnitExpected;
  }
  return "lengths: --unit-m with the length of a pixel on the ground, in m, if the image is a plan "
         "(for a job, `throng metrics --trajectory FILE --unit-m 0.03 --to walk.txt` converts the "
         "file), else positions in m by a homography";
}

}  // namespace throng::metrics
