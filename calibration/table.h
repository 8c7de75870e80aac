// Small tables of comma-separated values, the input files of calibrations.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace throng::calibrate {

struct TableRow {
  int line = 0;                    ///< line number in the file, from 1
  std::vector<std::string> cells;  ///< cells of the requested columns, in the requested order
};

struct Table {
  std::vector<TableRow> rows;
  std::vector<int> short_lines;  ///< numbers of lines that lack some of the columns
};

/// Reads the named columns, in any order of the header; cells of absent optional columns are "".
/// Skips empty lines and lines that begin with '#'. Throws InputError if the header lacks a column
/// or there are no rows.
Table read_table(const std::filesystem::path& file, const std::vector<std::string>& columns,
                 const std::vector<std::string>& optional_columns = {});

/// Parses text that is a finite number as a whole; else returns nothing.
std::optional<double> number_in(std::string_view text);

}  // namespace throng::calibrate
