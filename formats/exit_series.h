// The rows of one exit in exits/RUN.csv against each other: docs/metrics.md defines the columns.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

#include "formats/findings.h"

namespace throng::formats {

struct ExitRow {
  std::size_t line = 0;                 ///< in the file, from 1
  std::map<std::string, double> value;  ///< by column; NaN for texts
  std::string state;
  std::string state_offline;

  /// The number of a column; NaN if there is none.
  double operator[](const char* column) const;
};

/// Of one exit in one run, by frame.
using ExitSeries = std::map<std::int64_t, ExitRow>;

/// Columns that follow from others of their row, and rows that follow from earlier ones.
void check_exit_series(const std::string& file, const std::string& exit, const ExitSeries& series,
                       Findings& findings);

}  // namespace throng::formats
