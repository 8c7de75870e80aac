// The figures of a study: results of each policy in each case, with intervals, and the comparisons.
#pragma once

#include <array>
#include <vector>

#include "jobs/study/statistics.h"
#include "jobs/study/work.h"

namespace throng::study {

/// Median and quartiles over the runs.
struct Spread {
  double median = 0;
  double low = 0;
  double high = 0;
};

/// The time by which some share of the people is out. A run that ends before has an infinite one;
/// so is what then depends on it.
struct EscapePercentile {
  Spread spread;      ///< over the runs
  double mean_s = 0;  ///< over the runs
  Interval mean_95;   ///< Student's 95 % interval of the mean; NaN of a single run
  double high_s = 0;  ///< 95th percentile over the runs
  Interval high_95;   ///< 95 % interval of it, from order statistics; infinite of few runs
  double runs_for_5_percent = 0;  ///< number of runs for which mean_95 is the mean +- 5 %
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
  std::vector<EscapePercentile> percentiles;  ///< of kSummaryPercents
  int all_out = 0;                            ///< runs in which everybody got out
  double not_escaped = 0;                     ///< inside at the end, unhurt; mean over the runs
  double casualties = 0;                      ///< mean over the runs
  std::array<MeanAtHorizon, 2> means;
  double t90_to_bound = 0;  ///< median over runs of T90 / lower bound
  double mean_to_bound = 0;
  double t90_to_reference = 0;  ///< of T90 / reference time
  double mean_to_reference = 0;
  std::vector<double> exit_use;  ///< per exit: people who left by it, mean over the runs
  double left_by_no_exit = 0;    ///< people who left where there is no exit; mean over the runs
  double followed = 0;           ///< mean over the runs
};

/// A case against the baseline case under the same policy: run i of both has the same seed.
struct CaseDifference {
  std::size_t one_case = 0;
  std::size_t policy = 0;
  int percent = 0;          ///< of kIntervalPercents
  int runs = 0;             ///< pairs of runs
  double difference_s = 0;  ///< mean of this case's time less the baseline case's, over those pairs
  Interval difference_95;   ///< Student's interval of it
  SignedRank test;
  double holm_p = 1;  ///< test.p_value adjusted for all comparisons of cases
};

/// The mean of a time over the first runs, and its interval: how the result settles.
struct Convergence {
  std::vector<double> mean_s;     ///< over the first 2, 3, ... runs
  std::vector<Interval> mean_95;  ///< Student's
};

inline constexpr int kSummaryPercents[] = {25, 50, 75, 90, 95, 99};
inline constexpr int kIntervalPercents[] = {50, 90, 95};  ///< those that reports give intervals of

/// A row for each case and policy, in the study's order; those without outcomes have none.
std::vector<SummaryRow> summarize(const Study& study, const Outcomes& outcomes);

/// Every other case against Study::baseline_case; nothing where the study compares no cases.
std::vector<CaseDifference> compare_cases(const Study& study, const Outcomes& outcomes);

/// Convergence of the time by which so many percent of the people are out.
Convergence find_convergence(const std::vector<Outcome>& runs, int percent);

/// The row's figures of one of kSummaryPercents.
const EscapePercentile& find_percentile(const SummaryRow& row, int percent);

}  // namespace throng::study
