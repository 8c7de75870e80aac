#include "jobs/study/summary_tables.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

namespace throng::study {

namespace {

constexpr const char* kDash = "–";  // a warning of the case says why

std::string time_text(double seconds) {
  return std::isfinite(seconds) ? fmt::format("{:.0f}", seconds) : std::string("never");
}

std::string spread_text(const Spread& time) {
  return fmt::format("{} [{}-{}]", time_text(time.median), time_text(time.low),
                     time_text(time.high));
}

/// A mean or percentile, infinite where somebody never gets out, and its interval.
std::string estimate_text(double value, const Interval& interval) {
  if (!std::isfinite(value)) return "not everybody in every run";
  const auto end = [](double at) {
    return std::isfinite(at) ? fmt::format("{:.1f}", at) : std::string("?");
  };
  return fmt::format("{:.1f} [{}, {}]", value, end(interval.low), end(interval.high));
}

std::string p_text(double p) { return std::isfinite(p) ? fmt::format("{:.2g}", p) : "?"; }

bool compares_policies(const Study& study) { return study.policies.size() > 1; }

std::string exits_text(const Case& one, const SummaryRow& row) {
  std::string text;
  for (std::size_t e = 0; e < row.exit_use.size(); ++e) {
    const world::Exit& exit = one.scenario.exits[e];
    text += fmt::format("{}{} ", text.empty() ? "" : ", ", exit.id);
    text += exit.is_open(0) ? fmt::format("{:.0f}", row.exit_use[e]) : "closed";
  }
  if (row.left_by_no_exit > 0) text += fmt::format(" and {:.1f} by none", row.left_by_no_exit);
  return text;
}

/// A cell of the case's table, in Markdown and in HTML alike.
std::vector<std::string> case_header(const Case& one, bool compares) {
  std::vector<std::string> cells = {"policy"};
  for (const int percent : kSummaryPercents) cells.push_back(fmt::format("T{}", percent));
  cells.insert(cells.end(), {"all out", "left inside"});
  for (const double at_s : one.horizons_s) {
    cells.push_back(fmt::format("mean to {:.0f} s", at_s));
    if (!compares) continue;
    cells.insert(cells.end(), {"ratio", "difference [95 %]", "p", "p (Holm)"});
  }
  cells.insert(cells.end(), {"T90/bound", "T90/reference", "exits"});
  return cells;
}

std::vector<std::string> case_cells(const Study& study, const SummaryRow& row) {
  std::vector<std::string> cells = {study.policies[row.policy].title};
  for (const EscapePercentile& time : row.percentiles) {
    cells.push_back(spread_text(time.spread));
  }
  cells.push_back(fmt::format("{}/{}", row.all_out, row.runs));
  cells.push_back(fmt::format("{:.1f}", row.not_escaped));
  for (const MeanAtHorizon& at : row.means) {
    cells.push_back(
        std::isfinite(at.spread.median)
            ? fmt::format("{:.1f} [{:.1f}-{:.1f}]", at.spread.median, at.spread.low, at.spread.high)
            : kDash);
    if (!compares_policies(study)) continue;
    if (row.policy == study.baseline) {
      cells.insert(cells.end(), {"", "", "", ""});
      continue;
    }
    if (!std::isfinite(at.difference_s)) {
      cells.insert(cells.end(), {kDash, kDash, kDash, kDash});
      continue;
    }
    cells.push_back(fmt::format("{:.2f}", at.ratio_to_baseline));
    cells.push_back(fmt::format("{:+.1f} [{:+.1f}, {:+.1f}]", at.difference_s, at.difference_95.low,
                                at.difference_95.high));
    cells.push_back(fmt::format("{:.2g}", at.test.p_value));
    cells.push_back(fmt::format("{:.2g}", at.holm_p));
  }
  for (const double ratio : {row.t90_to_bound, row.t90_to_reference}) {
    cells.push_back(std::isfinite(ratio) ? fmt::format("{:.2f}", ratio) : kDash);
  }
  cells.push_back(exits_text(study.cases[row.one_case], row));
  return cells;
}

}  // namespace

Table case_table(const Study& study, const std::vector<SummaryRow>& rows, std::size_t one_case) {
  Table table{case_header(study.cases[one_case], compares_policies(study)), {}};
  for (const SummaryRow& row : rows) {
    if (row.one_case == one_case) table.rows.push_back(case_cells(study, row));
  }
  return table;
}

Table interval_table(const Study& study, const std::vector<SummaryRow>& rows) {
  Table table;
  table.header = {"case", "policy", "runs"};
  for (const int percent : kIntervalPercents) {
    table.header.push_back(fmt::format("mean T{}", percent));
  }
  table.header.insert(table.header.end(), {"95th percentile of T95", "runs for T95 +- 5 %"});
  for (const SummaryRow& row : rows) {
    std::vector<std::string> cells = {study.cases[row.one_case].title,
                                      study.policies[row.policy].title, std::to_string(row.runs)};
    for (const int percent : kIntervalPercents) {
      const EscapePercentile& time = find_percentile(row, percent);
      cells.push_back(estimate_text(time.mean_s, time.mean_95));
    }
    const EscapePercentile& last = find_percentile(row, 95);
    cells.push_back(estimate_text(last.high_s, last.high_95));
    cells.push_back(std::isfinite(last.runs_for_5_percent)
                        ? fmt::format("{:.0f}", last.runs_for_5_percent)
                        : "?");
    table.rows.push_back(std::move(cells));
  }
  return table;
}

Table case_difference_table(const Study& study, const std::vector<CaseDifference>& differences) {
  Table table{{"case", "policy", "time", "difference [95 %]", "p", "p (Holm)"}, {}};
  for (const CaseDifference& one : differences) {
    const std::string difference = std::isfinite(one.difference_s)
                                       ? fmt::format("{:+.1f} [{:+.1f}, {:+.1f}]", one.difference_s,
                                                     one.difference_95.low, one.difference_95.high)
                                       : "not everybody in every run";
    table.rows.push_back({study.cases[one.one_case].title, study.policies[one.policy].title,
                          fmt::format("T{}", one.percent), difference, p_text(one.test.p_value),
                          p_text(one.holm_p)});
  }
  return table;
}

std::string interval_explanation() {
  return "Means over the runs with Student's 95 % intervals, in s: how exact the mean over all "
         "possible runs of this model is known. 95th percentile: the time that 95 % of the runs "
         "do not exceed, with its 95 % interval from order statistics (its upper end is known "
         "from 72 runs on). Runs for T95 +- 5 %: estimated number of runs for which the interval "
         "of the mean T95 is 5 % of it to either side.";
}

std::string case_difference_explanation(const Study& study) {
  return fmt::format(
      "Time of the case less that of \"{}\" in s, mean over runs with the same seeds, with "
      "Student's 95 % interval; p: Wilcoxon's signed-rank test; p (Holm): adjusted for all "
      "comparisons of this table.",
      study.cases[*study.baseline_case].title);
}

std::string case_explanation(const Study& study) {
  std::string text = fmt::format(
      "Medians [quartiles] over {} runs{}; times in s, each person's from the later of alarm and "
      "arrival. Mean to a horizon: restricted mean survival time, people who are not out by then "
      "count with it. ",
      study.runs, compares_policies(study) ? " with paired seeds" : "");
  if (compares_policies(study)) {
    text += fmt::format(
        "Ratio, difference and p (Wilcoxon): of that mean to \"{}\", the interval by bootstrap; p "
        "(Holm): adjusted for all comparisons of the study. ",
        study.policies[study.baseline].title);
  }
  return text +
         "Left inside: unhurt at the end, mean. Bound, reference: docs/study.md. Exits: people "
         "who left by each exit, mean; by none: who left where there is no exit.";
}

}  // namespace throng::study
