// Small tables of comma-separated values, as calibrations are fed with.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace throng::calibrate {

struct TableRow {
  int line = 0;                    ///< of the file, from 1
  std::vector<std::string> cells;  ///< of the columns that were asked for, in that order
};

struct Table {
  std::vector<TableRow> rows;
  std::vector<int> short_lines;  ///< lines that lack some of the columns
};

/// Reads the named columns, in whatever order the header has them; "" for optional columns that are
/// not there. Empty lines and lines that begin with '#' do not count. Throws InputError when the
/// header lacks a column or there are no rows.
Table read_table(const std::filesystem::path& file, const std::vector<std::string>& columns,
                 const std::vector<std::string>& optional_columns = {});

/// A finite number that is the whole text.
std::optional<double> number_in(std::string_view text);

}  // namespace throng::calibrate
