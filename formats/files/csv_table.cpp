#include "formats/files/csv_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <limits>

#include "base/error.h"

namespace throng::formats {

namespace {

/// The cells of a line. Ends of lines within quotes do not occur in ids.
std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  bool is_quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (is_quoted && c == '"' && i + 1 < line.size() && line[i + 1] == '"') {
      cells.back().push_back(line[++i]);
    } else if (c == '"') {
      is_quoted = !is_quoted;
    } else if (c == ',' && !is_quoted) {
      cells.emplace_back();
    } else if (c != '\r') {
      cells.back().push_back(c);
    }
  }
  return cells;
}

}  // namespace

std::size_t CsvTable::find(const std::string& name) const {
  return static_cast<std::size_t>(std::find(columns.begin(), columns.end(), name) -
                                  columns.begin());
}

CsvTable read_csv(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string line;
  if (!file || !std::getline(file, line)) {
    throw InputError({path.string(), "", "no such file, or an empty one", "a table"});
  }
  CsvTable table;
  table.columns = cells_of(line);
  while (std::getline(file, line)) {
    table.rows.push_back(cells_of(line));
    if (table.rows.back().size() == table.columns.size()) continue;
    throw InputError({path.string(), fmt::format("line {}", table.rows.size() + 1),
                      fmt::format("{} cells", table.rows.back().size()),
                      fmt::format("{} cells", table.columns.size())});
  }
  return table;
}

double number_of(const std::string& cell) {
  char* end = nullptr;
  const double value = std::strtod(cell.c_str(), &end);
  return cell.empty() || *end != '\0' ? std::numeric_limits<double>::quiet_NaN() : value;
}

}  // namespace throng::formats
