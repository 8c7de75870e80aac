// A study's table: what each policy came to in each case, and how it compares with the baseline.
#pragma once

#include <array>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
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

/// The restricted mean of the escape times up to a horizon, against the baseline.
struct MeanAtHorizon {
  double at_s = 0;
  Spread spread;                 ///< over the runs
  double mean_s = 0;             ///< over the runs
  double inside = 0;             ///< people still inside then, unhurt; mean over the runs
  double ratio_to_baseline = 1;  ///< of mean_s
  double difference_s = 0;       ///< mean of the paired differences to the baseline
  Interval difference_95;        ///< bootstrap interval of it
  SignedRank test;
  double holm_p = 1;  ///< test.p_value adjusted for all comparisons of the study
};

/// One case and policy. Times in s from the later of alarm and arrival.
struct SummaryRow {
  std::size_t one_case = 0;
  std::size_t policy = 0;
  int runs = 0;
  std::vector<Spread> percentiles;  ///< of kSummaryPercents
  int all_out = 0;                  ///< runs in which everybody got out
  double not_escaped = 0;           ///< inside at the end, unhurt; mean over the runs
  double casualties = 0;            ///< mean over the runs
  std::array<MeanAtHorizon, 2> means;
  double t90_to_bound = 0;  ///< median over runs of T90 / lower bound
  double mean_to_bound = 0;
  double t90_to_reference = 0;  ///< of T90 / reference time
  double mean_to_reference = 0;
  std::vector<double> exit_use;  ///< per exit: net number gone out, mean over the runs
  double followed = 0;           ///< mean over the runs
};

inline constexpr int kSummaryPercents[] = {25, 50, 75, 90, 95, 99};

/// Cases without outcomes have no rows.
std::vector<SummaryRow> summarize(const Study& study, const Outcomes& outcomes);

/// The summary as summary.json holds it.
nlohmann::json summary_json(const Study& study, const Outcomes& outcomes);

/// Writes summary.csv, summary.json, summary.md, values.json (study/values.h) and report.html,
/// which has the tables and the escape curves of each case as charts, into the folder. Equal
/// outcomes give equal bytes.
void write_report(const Study& study, const Outcomes& outcomes,
                  const std::filesystem::path& folder);

}  // namespace throng::study
