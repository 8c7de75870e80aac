#include "calibration/control_points.h"

#include <fmt/core.h>

#include <optional>
#include <set>

#include "calibration/table.h"

namespace throng::calibrate {

namespace {

/// The cells' numbers; problems for those that are none.
std::vector<double> parse_numbers(const std::filesystem::path& file, const TableRow& row,
                                  std::size_t first, std::size_t count,
                                  std::vector<Problem>& problems) {
  std::vector<double> numbers;
  for (std::size_t i = first; i < first + count; ++i) {
    const std::optional<double> number = number_in(row.cells[i]);
    if (!number) {
      problems.push_back({file.string(), fmt::format("line {}", row.line),
                          fmt::format("\"{}\"", row.cells[i]), "a finite number"});
    }
    numbers.push_back(number.value_or(0));
  }
  return numbers;
}

}  // namespace

ControlPoints read_control_points(const std::filesystem::path& file) {
  const Table table = read_table(file, {"point", "X", "Y", "Z"}, {"sd"});
  constexpr std::size_t kSdCell = 4;
  ControlPoints points;
  std::vector<Problem> problems;
  for (const TableRow& row : table.rows) {
    const std::size_t count = row.cells[kSdCell].empty() ? 3 : 4;  // without a deviation: exact
    std::vector<double> n = parse_numbers(file, row, 1, count, problems);
    n.resize(kSdCell, 0);
    if (n[3] < 0) {
      problems.push_back({file.string(), fmt::format("line {}", row.line),
                          fmt::format("a deviation of {}", n[3]), "0 or more"});
    }
    if (!points.emplace(row.cells[0], ControlPoint{{n[0], n[1], n[2]}, n[3]}).second) {
      problems.push_back({file.string(), fmt::format("line {}", row.line),
                          fmt::format("point {} again", row.cells[0]), "each point once"});
    }
  }
  if (!problems.empty()) throw InputError(problems);
  return points;
}

std::vector<NamedPixel> read_named_pixels(const std::filesystem::path& file) {
  const Table table = read_table(file, {"point", "u", "v"}, {"image"});
  std::vector<NamedPixel> pixels;
  std::vector<Problem> problems;
  std::set<std::pair<std::string, std::string>> seen;
  for (const TableRow& row : table.rows) {
    const std::vector<double> n = parse_numbers(file, row, 1, 2, problems);
    const std::string& image = row.cells[3];
    pixels.push_back({image, row.cells[0], {n[0], n[1]}});
    if (!seen.emplace(image, row.cells[0]).second) {
      problems.push_back({file.string(), fmt::format("line {}", row.line),
                          fmt::format("point {} of image \"{}\" again", row.cells[0], image),
                          "each point once per image"});
    }
  }
  if (!problems.empty()) throw InputError(problems);
  return pixels;
}

}  // namespace throng::calibrate
