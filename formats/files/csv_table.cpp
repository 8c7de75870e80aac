#include "formats/files/csv_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <limits>

#include "base/error.h"
#include "base/files/untrusted_folders.h"
#include "base/text/csv.h"

namespace throng::formats {

std::size_t CsvTable::find(const std::string& name) const {
  return static_cast<std::size_t>(std::find(columns.begin(), columns.end(), name) -
                                  columns.begin());
}

CsvTable read_csv(const std::filesystem::path& path) {
  std::ifstream file = open_stream(path);
  std::string line;
  if (!file || !std::getline(file, line)) {
    throw InputError({path.string(), "", "no such file, or an empty one", "a table"});
  }
  CsvTable table;
  table.columns = csv_cells(line);
  while (std::getline(file, line)) {
    table.rows.push_back(csv_cells(line));
    if (table.rows.back().size() == table.columns.size()) continue;
    throw InputError({path.string(), fmt::format("line {}", table.rows.size() + 1),
                      fmt::format("{} cells", table.rows.back().size()),
                      fmt::format("{} cells", table.columns.size())});
  }
  return table;
}

double parse_number(const std::string& cell) {
  char* end = nullptr;
  const double value = std::strtod(cell.c_str(), &end);
  return cell.empty() || *end != '\0' ? std::numeric_limits<double>::quiet_NaN() : value;
}

}  // namespace throng::formats
