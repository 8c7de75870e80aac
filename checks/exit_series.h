// Consistency of the rows of one exit in exits/RUN.csv; docs/metrics.md defines the columns.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

#include "checks/findings.h"

namespace throng::checks {

// Constants of docs/metrics.md, repeated so that the checks do not depend on the checked code.
inline constexpr double kCapacityPerMs = 1.3;  ///< capacity of a door, people per meter and second
inline constexpr double kWaitWindowS = 20;     ///< predicted wait: window of the measured flow
inline constexpr double kWaitPriorS = 10;      ///< predicted wait: time at capacity as a prior
inline constexpr double kMinLaneM = 0.8;  ///< predicted wait: min width of the used part of a door

/// A row of the file.
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

/// Checks columns that follow from others of their row, and rows that follow from earlier rows.
void check_exit_series(const std::string& file, const std::string& exit, const ExitSeries& series,
                       Findings& findings);

}  // namespace throng::checks
