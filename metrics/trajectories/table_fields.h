// Fields of the lines of a table, and their numbers.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace throng::metrics {

/// Returns the separator of a table's first line: the one of comma, semicolon and tab that it has
/// most of, or else the space. Commas between digits separate decimals if other separators remain.
char detect_separator(std::string_view line);

/// Returns the fields of a line without their blanks and double quotes. Several spaces are one
/// separator.
std::vector<std::string_view> split_fields(std::string_view line, char separator);

/// Returns the names of columns in a line: fields, with words in brackets joined to the one before
/// ("x [ft] y [ft]" has two).
std::vector<std::string_view> split_names(std::string_view line, char separator);

/// A number with the character that separates its decimals: '.', ',' or 0 for neither.
struct FieldNumber {
  double value = 0;
  char decimal = 0;
};

/// Parses a finite number with a decimal point or a decimal comma; a field with both is no number.
std::optional<FieldNumber> field_number(std::string_view field);

/// Parses a time: a number, "HH:MM:SS", or a date and time such as "2026-05-01T12:00:00.04Z", in
/// seconds since 1970 (without regard to time zones, since times are counted from the first).
std::optional<FieldNumber> field_time(std::string_view field);

}  // namespace throng::metrics
