// Summary of a study: results of each policy in each case with confidence intervals, and
// comparisons.
#pragma once

#include <array>
#include <string>
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

/// The time by which a percentage of the people is out. It is infinite for runs that end earlier,
/// and so are statistics that depend on them.
struct EscapePercentile {
  Spread spread;      ///< over the runs
  double mean_s = 0;  ///< over the runs
  Interval mean_95;   ///< Student's 95 % interval of the mean; NaN for a single run
  double high_s = 0;  ///< 95th percentile over the runs
  Interval high_95;   ///< 95 % interval of high_s, from order statistics; infinite for few runs
  double runs_for_5_percent = 0;  ///< number of runs for which mean_95 would be the mean +- 5 %
};

/// The restricted mean of the escape times up to a horizon, compared with the baseline. Values
/// that depend on a run in which nobody was watched for so long are NaN.
struct MeanAtHorizon {
  double at_s = 0;               ///< the horizon
  Spread spread;                 ///< over the runs
  double mean_s = 0;             ///< over the runs
  double inside = 0;             ///< unhurt people inside at the horizon; mean over the runs
  double ratio_to_baseline = 1;  ///< of mean_s
  double difference_s = 0;       ///< mean of the paired differences to the baseline
  Interval difference_95;        ///< bootstrap interval of difference_s
  SignedRank test;               ///< of the paired differences
  double holm_p = 1;             ///< test.p_value adjusted for all comparisons of the study
};

/// Results of one case and policy. Times are in s from the later of alarm and arrival.
struct SummaryRow {
  std::size_t one_case = 0;
  std::size_t policy = 0;
  int runs = 0;
  std::vector<EscapePercentile> percentiles;  ///< one per kSummaryPercents
  int all_out = 0;                            ///< number of runs in which all people got out
  double not_escaped = 0;                     ///< unhurt people inside at the end; mean over runs
  double casualties = 0;                      ///< mean over the runs
  std::array<MeanAtHorizon, 2> means;
  double t90_to_bound = 0;       ///< T90 / lower bound; median over the runs
  double mean_to_bound = 0;      ///< mean escape time / lower bound; median over the runs
  double t90_to_reference = 0;   ///< T90 / reference time; median over the runs
  double mean_to_reference = 0;  ///< mean escape time / reference time; median over the runs
  std::vector<double> exit_use;  ///< per exit: people who left by it, mean over the runs
  double left_by_no_exit = 0;    ///< people who left where there is no exit; mean over the runs
  double followed = 0;           ///< people who followed a guide; mean over the runs
};

/// A case compared with the baseline case under the same policy; run i of both has the same seed.
struct CaseDifference {
  std::size_t one_case = 0;
  std::size_t policy = 0;
  int percent = 0;          ///< one of kIntervalPercents
  int runs = 0;             ///< number of pairs of runs
  double difference_s = 0;  ///< mean over the pairs of this case's time less the baseline case's
  Interval difference_95;   ///< Student's 95 % interval of difference_s
  SignedRank test;
  double holm_p = 1;  ///< test.p_value adjusted for all comparisons of cases
};

/// Running mean of a time over the first runs, with its interval.
struct Convergence {
  std::vector<double> mean_s;     ///< over the first 2, 3, ... runs
  std::vector<Interval> mean_95;  ///< Student's 95 % intervals
};

inline constexpr int kSummaryPercents[] = {25, 50, 75, 90, 95, 99};
inline constexpr int kIntervalPercents[] = {50, 90, 95};  ///< percentages with intervals in reports

/// One row for each case and policy with outcomes, in the study's order.
std::vector<SummaryRow> summarize(const Study& study, const Outcomes& outcomes);

/// The warnings of each case: findings about its scenario, warnings of its runs, people who left
/// where there is no exit, and means that are not known.
std::vector<std::vector<std::string>> case_warnings(const Study& study, const Outcomes& outcomes,
                                                    const std::vector<SummaryRow>& rows);

/// Compares every other case with Study::baseline_case; empty if the study does not compare cases.
std::vector<CaseDifference> compare_cases(const Study& study, const Outcomes& outcomes);

/// Convergence of the time by which `percent` % of the people are out.
Convergence find_convergence(const std::vector<Outcome>& runs, int percent);

/// The row's entry for one of kSummaryPercents.
const EscapePercentile& find_percentile(const SummaryRow& row, int percent);

}  // namespace throng::study
