// A study's table: what each policy came to in each case, and how it compares with the baseline.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "study/statistics.h"
#include "study/work.h"

namespace throng::study {

/// Median and quartiles over the runs.
struct Spread {
  double median = 0;
  double low = 0;
  double high = 0;
};

/// One case and policy. Times in s from the alarm.
struct SummaryRow {
  std::size_t one_case = 0;
  std::size_t policy = 0;
  int runs = 0;
  std::vector<Spread> percentiles;  ///< of kSummaryPercents
  int all_out = 0;                  ///< runs in which everybody got out
  Spread mean_escape;               ///< of the censored mean escape time, the primary endpoint
  double mean_escape_mean = 0;      ///< over the runs
  double ratio_to_baseline = 1;     ///< of mean_escape_mean
  double difference = 0;            ///< mean of the paired differences to the baseline
  Interval difference_95;           ///< bootstrap interval of it
  SignedRank test;
  double t90_to_bound = 0;  ///< median over runs of T90 / lower bound
  double mean_to_bound = 0;
  std::vector<double> exit_use;  ///< per exit, mean over the runs
  double followed = 0;           ///< mean over the runs
};

inline constexpr int kSummaryPercents[] = {25, 50, 75, 90, 95, 99};

std::vector<SummaryRow> summarise(const Study& study, const Outcomes& outcomes);

/// Writes summary.csv, summary.json, summary.md and report.html, which has the tables and the
/// escape curves of each case as charts, into the folder. Equal outcomes give equal bytes.
void write_report(const Study& study, const Outcomes& outcomes,
                  const std::filesystem::path& folder);

}  // namespace throng::study
