// Lines of CSV files (RFC 4180).
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace throng {

/// The cells of a line that holds a whole record; quotes around cells are removed, doubled ones
/// become one, a carriage return at the end is left out. At least one cell.
std::vector<std::string> csv_cells(std::string_view line, char separator = ',');

}  // namespace throng
