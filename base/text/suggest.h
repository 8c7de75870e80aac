// Suggestions for misspelled words ("did you mean ...?").
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace throng {

/// Number of letters to insert, omit, replace or swap with a neighbor to get from one word to the
/// other, ignoring case (Damerau-Levenshtein distance, optimal string alignment).
std::size_t edit_distance(std::string_view a, std::string_view b);

/// Returns the first candidate with the smallest edit_distance() to `word`. If more than a third of
/// the letters differ, returns the first candidate that continues the word after '-', '_', '/' or
/// '.' ("yolo-detect" for "yolo"), else nothing.
std::optional<std::string_view> closest(std::string_view word,
                                        std::span<const std::string_view> candidates);

/// Returns " (did you mean x?)", or an empty text.
std::string did_you_mean(std::string_view word, std::span<const std::string_view> candidates);

/// Returns the problem of an unknown name with the closest known name, or else all known names:
/// `unknown field "drone"; did you mean "drones"?`. `kind` is, for example, "field" or "scenario".
Problem unknown_name(std::string source, std::string where, std::string_view kind,
                     std::string_view name, std::span<const std::string_view> known);

}  // namespace throng
