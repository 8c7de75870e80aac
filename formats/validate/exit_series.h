// The rows of one exit in exits/RUN.csv against each other: docs/metrics.md defines the columns.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

#include "formats/validate/findings.h"

namespace throng::formats {

/// Definitions of docs/metrics.md, stated here once more: checks do not rely on what they check.
inline constexpr double kCapacityPerMs = 1.3;  ///< of a door, people per meter and second
inline constexpr double kWaitWindowS = 20;     ///< predicted waits: the flow of the last seconds,
inline constexpr double kWaitPriorS = 10;      ///< with this time at the capacity
inline constexpr double kMinLaneM = 0.8;       ///< of at least this part of the door

struct ExitRow {
  std::size_t line = 0;                 ///< in the file, from 1
  std::map<std::string, double> value;  ///< by column; NaN for texts
  std::string state;
  std::string state_offline;

  /// The number of a column; NaN if there is none.
  double operator[](const char* column) const;
};

/// Rows of one exit in one run, by frame.
using ExitSeries = std::map<std::int64_t, ExitRow>;

/// Columns that follow from others of their row, and rows that follow from earlier ones.
void check_exit_series(const std::string& file, const std::string& exit, const ExitSeries& series,
                       Findings& findings);

}  // namespace throng::formats
