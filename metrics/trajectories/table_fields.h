// Fields of the lines of a table, and their numbers.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace throng::metrics {

/// A line of a file, for messages.
struct TableLine {
  const std::string& file;
  int number = 0;  ///< from 1

  /// Throws InputError.
  [[noreturn]] void reject(const std::string& found, const std::string& expected) const;
};

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

/// The numbers of a table, which have one decimal separator throughout.
class TableNumbers {
 public:
  /// The number in a field. Throws InputError.
  double read(std::string_view field, const TableLine& line);
  /// Refuses points beside decimal commas, which may separate thousands. Throws InputError.
  void note_decimal(char decimal, const TableLine& line);

 private:
  char decimal_ = 0;  ///< 0: not known yet
};

/// Parses a time: a number, "HH:MM:SS", or a date and time such as "2026-05-01T12:00:00.04Z", in
/// seconds since 1970 (without regard to time zones, since times are counted from the first).
std::optional<FieldNumber> field_time(std::string_view field);

}  // namespace throng::metrics
