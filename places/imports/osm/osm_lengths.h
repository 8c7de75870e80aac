// Lengths and counts as mappers write them: the spellings of wiki.openstreetmap.org/wiki/Key:height
// and of Map_Features/Units, and common ones that these pages call wrong.
#pragma once

#include <optional>
#include <string_view>

namespace throng::imports {

/// Reads a length (m) such as "12", "12.5 m", "3,5", "~12 meters", "40 ft", "22' 3\"" or "250 cm".
/// Of several values ("8;12", "8-12 m") the largest counts. Nothing for other text, also for a
/// comma before three digits, which may be one of thousands; nothing for negative lengths and
/// lengths above 1 km.
std::optional<double> length_in(std::string_view text);

/// Reads a number of levels or lanes such as "3", "2.5", "2;3" or "3 levels"; the largest of
/// several. Nothing for other text, negative numbers and numbers above 300.
std::optional<double> count_in(std::string_view text);

}  // namespace throng::imports
