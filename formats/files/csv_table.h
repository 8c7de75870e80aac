// Reader for CSV tables of a dataset (RFC 4180).
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace throng::formats {

/// A table with a header line.
struct CsvTable {
  std::vector<std::string> columns;            ///< names from the header line
  std::vector<std::vector<std::string>> rows;  ///< one cell per column

  /// The index of a column; columns.size() if there is none with this name.
  std::size_t find(const std::string& name) const;
};

/// Reads a table. Throws InputError if the file does not exist or is empty, or if a line, which the
/// message names, has another number of cells than the header.
CsvTable read_csv(const std::filesystem::path& path);

/// The cell as a number; NaN for other text.
double parse_number(const std::string& cell);

}  // namespace throng::formats
