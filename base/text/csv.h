// Records of CSV files (RFC 4180).
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace throng {

/// Splits a line that holds a whole record into its cells, at least one. Removes the quotes around
/// cells, replaces doubled quotes by single ones, and drops carriage returns.
std::vector<std::string> csv_cells(std::string_view line, char separator = ',');

}  // namespace throng
