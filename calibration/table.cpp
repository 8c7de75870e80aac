#include "calibration/table.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

#include "base/error.h"
#include "base/files/files.h"
#include "base/text/csv.h"
#include "base/text/utf8.h"
#include "base/text/words.h"

namespace throng::calibrate {

namespace {

/// Spreadsheets of countries with decimal commas separate cells by semicolons.
char find_separator(std::string_view header) {
  for (const char separator : {';', '\t'}) {
    if (header.find(separator) != std::string_view::npos) return separator;
  }
  return ',';
}

/// "12,5" as "12.5"; other texts are left as they are.
void replace_decimal_comma(std::string& cell) {
  const auto comma = cell.find(',');
  if (comma == std::string::npos || cell.find(',', comma + 1) != std::string::npos) return;
  std::string number = cell;
  number[comma] = '.';
  if (number_in(number)) cell = number;
}

}  // namespace

std::optional<double> number_in(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = result.ec == std::errc() && result.ptr == text.data() + text.size();
  return whole && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

Table read_table(const std::filesystem::path& file, const std::vector<std::string>& columns,
                 const std::vector<std::string>& optional_columns) {
  const std::string text = read_file(file);
  std::istringstream lines{std::string(without_byte_order_mark(text))};
  Table table;
  std::vector<std::size_t> places;
  int number = 0;
  char separator = ',';
  for (std::string line; std::getline(lines, line);) {
    ++number;
    const std::string_view content = trimmed(line);
    if (content.empty() || content.starts_with('#')) continue;
    if (places.empty()) separator = find_separator(content);
    std::vector<std::string> cells = csv_cells(content, separator);
    for (std::string& cell : cells) {
      cell = std::string(trimmed(cell));
      if (separator != ',') replace_decimal_comma(cell);
    }
    if (places.empty()) {
      std::vector<std::string> wanted = columns;
      wanted.insert(wanted.end(), optional_columns.begin(), optional_columns.end());
      for (const std::string& column : wanted) {
        const auto found = std::find(cells.begin(), cells.end(), column);
        places.push_back(static_cast<std::size_t>(found - cells.begin()));
        if (found == cells.end() && places.size() <= columns.size()) {
          throw InputError(
              Problem{file.string(), fmt::format("line {}", number),
                      fmt::format("a header without the column \"{}\"", column),
                      fmt::format("a header with the columns {}", fmt::join(columns, ","))});
        }
      }
      continue;
    }
    TableRow row{number, {}};
    for (std::size_t i = 0; i < places.size(); ++i) {
      row.cells.push_back(places[i] < cells.size() ? cells[places[i]] : "");
    }
    const bool short_line = std::any_of(
        row.cells.begin(), row.cells.begin() + static_cast<std::ptrdiff_t>(columns.size()),
        [](const std::string& cell) { return cell.empty(); });
    if (short_line) table.short_lines.push_back(number);
    table.rows.push_back(std::move(row));
  }
  if (table.rows.empty()) {
    throw InputError(Problem{file.string(), "", "no rows", "a header and at least one row"});
  }
  return table;
}

}  // namespace throng::calibrate
