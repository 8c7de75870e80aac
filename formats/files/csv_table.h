// Tables of comma-separated values (RFC 4180) that a dataset has.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace throng::formats {

struct CsvTable {
  std::vector<std::string> columns;            ///< names, of the first line
  std::vector<std::vector<std::string>> rows;  ///< as many cells as there are columns

  /// The number of a column, or the number of columns if there is none of this name.
  std::size_t find(const std::string& name) const;
};

/// Throws InputError naming the line when the file is not there or a line has another number of
/// cells than the first.
CsvTable read_csv(const std::filesystem::path& path);

/// The cell's number; NaN if it is none.
double parse_number(const std::string& cell);

}  // namespace throng::formats
