// Units by their words, and in the names of columns.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace throng::metrics {

/// A unit as somebody wrote it.
struct Unit {
  enum class Kind : std::uint8_t { unknown, length, time, frames, pixels };
  Kind kind = Kind::unknown;
  double factor = 1;      ///< m of a length, s of a time
  std::string word = {};  ///< as found

  /// Whether it says what positions are in, be it usable or not.
  bool is_of_positions() const { return kind == Kind::length || kind == Kind::pixels; }
};

/// In lower case, with "u" for the micro sign.
std::string normalized_words(std::string_view text);

/// The unit that a word means, in singular or plural: "cm", "Feet", "yards", "millimetre", "ms",
/// "px"; of the kind `unknown` if none.
Unit unit_of_word(std::string_view word);

/// The unit in the name of a column: in brackets or behind a slash ("X [mm]", "x/m"), where any
/// other word is an unknown unit; or as the last word ("x_cm", "pos x ft"). Nothing without one.
std::optional<Unit> unit_in_name(std::string_view name);

/// The word in the last square brackets of a text: "x-coordinate (meter [m])".
std::optional<Unit> last_unit_in(std::string_view text);

/// The text that a message expects instead of a unit that cannot be used for positions.
std::string expected_unit(const Unit& unit);

}  // namespace throng::metrics
