// Readers of COCO's masks, written for the tests only: the slow and obvious way.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace throng::annotate {

/// Run lengths of a compressed counts string.
inline std::vector<std::int64_t> runs_of_counts(const std::string& counts) {
  std::vector<std::int64_t> runs;
  std::size_t at = 0;
  while (at < counts.size()) {
    std::int64_t value = 0;
    int shift = 0;
    int character = 0;
    do {
      character = counts.at(at++) - 48;
      value += static_cast<std::int64_t>(character % 32) << shift;
      shift += 5;
    } while (character >= 32);
    const bool is_negative = character % 32 >= 16;
    if (is_negative) value -= std::int64_t{1} << shift;
    if (runs.size() > 2) value += runs[runs.size() - 2];
    runs.push_back(value);
  }
  return runs;
}

/// Row-major mask of runs that go down the columns.
template <typename Runs>
std::vector<bool> mask_of_runs(const Runs& runs, int width, int height) {
  std::vector<bool> mask(static_cast<std::size_t>(width) * height);
  std::size_t at = 0;
  bool is_set = false;
  for (const auto length : runs) {
    for (std::int64_t i = 0; i < static_cast<std::int64_t>(length); ++i, ++at) {
      const std::size_t column = at / height;
      const std::size_t row = at % height;
      if (is_set) mask.at(row * width + column) = true;
    }
    is_set = !is_set;
  }
  mask.resize(at);  // too few or too many pixels show as another size
  return mask;
}

}  // namespace throng::annotate
