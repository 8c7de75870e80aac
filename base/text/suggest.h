// "Did you mean ...?": the known word that a misspelled one is nearest to.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace throng {

/// Letters to insert, omit, replace or swap with a neighbor to make one word of the other, whatever
/// their case (Damerau-Levenshtein distance as optimal string alignment).
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The candidate with the smallest edit_distance() to `word`, the first of equals. If more than a
/// third of the letters differ, the first of those that begin with the word and go on behind a
/// '-', '_', '/' or '.' ("yolo" for "yolo-detect"), else nothing.
std::optional<std::string_view> closest(std::string_view word,
                                        std::span<const std::string_view> candidates);

/// " (did you mean x?)", or nothing.
std::string did_you_mean(std::string_view word, std::span<const std::string_view> candidates);

/// A name that is not among the known ones, with the nearest of them, else with all:
/// `unknown field "drone"; did you mean "drones"?`. `kind` is "field", "scenario" and the like.
Problem unknown_name(std::string source, std::string where, std::string_view kind,
                     std::string_view name, std::span<const std::string_view> known);

}  // namespace throng
