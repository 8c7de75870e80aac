#include "jobs/study/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <set>

#include "base/error.h"

namespace throng::study {

namespace {

constexpr double kConfidence = 0.95;
constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();

Spread compute_spread(const std::vector<double>& values) {
  return {median(values), quantile(values, 0.25), quantile(values, 0.75)};
}

template <typename Value>
std::vector<double> each(const std::vector<Outcome>& runs, const Value& value) {
  std::vector<double> values;
  values.reserve(runs.size());
  for (const Outcome& run : runs) values.push_back(value(run));
  return values;
}

bool all_finite(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(),
                     [](double value) { return std::isfinite(value); });
}

Interval student_95(const std::vector<double>& values) {
  if (!all_finite(values)) return {kNotKnown, kNotKnown};
  return student_interval(values, kConfidence);
}

/// The half width of an interval of a mean falls with the root of the number of runs.
double runs_for(double relative_half_width, double mean_s, const Interval& mean_95,
                std::size_t runs) {
  const double half_s = 0.5 * (mean_95.high - mean_95.low);
  if (!std::isfinite(half_s) || mean_s <= 0) return kNotKnown;
  const double factor = half_s / (relative_half_width * mean_s);
  return std::max(2.0, std::ceil(static_cast<double>(runs) * factor * factor));
}

EscapePercentile percentile_over(const std::vector<double>& times_s) {
  constexpr double kHigh = 0.95;
  constexpr double kRelativeHalfWidth = 0.05;
  EscapePercentile result;
  result.spread = compute_spread(times_s);
  result.mean_s = mean(times_s);
  result.mean_95 = student_95(times_s);
  result.high_s = quantile(times_s, kHigh);
  result.high_95 = quantile_interval(times_s, kHigh, kConfidence);
  result.runs_for_5_percent =
      runs_for(kRelativeHalfWidth, result.mean_s, result.mean_95, times_s.size());
  return result;
}

std::vector<double> times_s(const std::vector<Outcome>& runs, int percent) {
  return each(runs, [percent](const Outcome& run) { return run.percentile_s(percent); });
}

MeanAtHorizon mean_at(double at_s, const std::vector<Outcome>& runs,
                      const std::vector<Outcome>& baseline, std::uint64_t seed) {
  const auto mean_s = [at_s](const Outcome& run) { return run.restricted_mean_s(at_s); };
  MeanAtHorizon result;
  result.at_s = at_s;
  const std::vector<double> means_s = each(runs, mean_s);
  const std::vector<double> baseline_s = each(baseline, mean_s);
  result.inside = mean(
      each(runs, [at_s](const Outcome& run) -> double { return run.escapes.inside_after(at_s); }));
  result.mean_s = mean(means_s);
  result.spread = {kNotKnown, kNotKnown, kNotKnown};
  if (all_finite(means_s)) result.spread = compute_spread(means_s);
  result.ratio_to_baseline = result.mean_s / mean(baseline_s);
  std::vector<double> differences;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    differences.push_back(means_s[i] - baseline_s[i]);
  }
  result.difference_s = mean(differences);
  if (!all_finite(differences)) {
    result.difference_95 = {kNotKnown, kNotKnown};
    result.test.p_value = kNotKnown;
    return result;
  }
  result.difference_95 = bootstrap_mean(differences, kConfidence, seed);
  result.test = wilcoxon_signed_rank(differences);
  return result;
}

SummaryRow summarize_one(const Case& one, const std::vector<Outcome>& runs,
                         const std::vector<Outcome>& baseline, std::uint64_t seed) {
  SummaryRow row;
  row.runs = static_cast<int>(runs.size());
  for (const int percent : kSummaryPercents) {
    row.percentiles.push_back(percentile_over(times_s(runs, percent)));
  }
  for (std::size_t i = 0; i < row.means.size(); ++i) {
    row.means[i] = mean_at(one.horizons_s[i], runs, baseline, seed);
  }
  for (const Outcome& run : runs) {
    if (static_cast<int>(run.escapes.escape_s.size()) == run.escapes.evacuees()) ++row.all_out;
  }
  const auto mean_of = [&](const auto& value) { return mean(each(runs, value)); };
  row.not_escaped = mean_of([](const Outcome& run) -> double { return run.escapes.not_escaped(); });
  row.casualties = mean_of(
      [](const Outcome& run) { return static_cast<double>(run.escapes.casualties.size()); });
  const auto ratios = [&](BestFigures Outcome::*best, double& t90, double& of_mean) {
    t90 = median(
        each(runs, [&](const Outcome& run) { return run.percentile_s(90) / (run.*best).t90_s; }));
    of_mean = median(each(runs, [&](const Outcome& run) {
      return run.escapes.mean_censored_s() / (run.*best).mean_s;
    }));
  };
  ratios(&Outcome::bound, row.t90_to_bound, row.mean_to_bound);
  ratios(&Outcome::reference, row.t90_to_reference, row.mean_to_reference);
  for (std::size_t e = 0; e < runs.front().counts.left_by.size(); ++e) {
    row.exit_use.push_back(
        mean_of([&](const Outcome& run) -> double { return run.counts.left_by[e].people; }));
  }
  row.left_by_no_exit =
      mean_of([](const Outcome& run) -> double { return run.counts.left_by_no_exit; });
  row.followed = mean_of([](const Outcome& run) -> double { return run.followed; });
  return row;
}

// Every comparison with the baseline at either horizon is one of the study's tests.
void adjust_p_values(std::size_t baseline, std::vector<SummaryRow>& rows) {
  std::vector<double> p_values;
  for (const SummaryRow& row : rows) {
    if (row.policy == baseline) continue;
    for (const MeanAtHorizon& at : row.means) p_values.push_back(at.test.p_value);
  }
  const std::vector<double> adjusted = holm_adjusted(p_values);
  std::size_t next = 0;
  for (SummaryRow& row : rows) {
    if (row.policy == baseline) continue;
    for (MeanAtHorizon& at : row.means) at.holm_p = adjusted[next++];
  }
}

/// The number of runs with each warning.
std::map<std::string, std::size_t> runs_by_warning(const std::vector<Outcome>& runs) {
  std::map<std::string, std::size_t> counts;
  for (const Outcome& run : runs) {
    for (const std::string& text : std::set(run.warnings.begin(), run.warnings.end())) {
      ++counts[text];
    }
  }
  return counts;
}

CaseDifference case_difference(const std::vector<double>& times, const std::vector<double>& base) {
  CaseDifference result;
  std::vector<double> differences;
  for (std::size_t i = 0; i < std::min(times.size(), base.size()); ++i) {
    differences.push_back(times[i] - base[i]);
  }
  result.runs = static_cast<int>(differences.size());
  if (!all_finite(differences)) {
    result.difference_s = kNotKnown;
    result.difference_95 = {kNotKnown, kNotKnown};
    result.test.p_value = kNotKnown;
    return result;
  }
  result.difference_s = mean(differences);
  result.difference_95 = student_95(differences);
  result.test = wilcoxon_signed_rank(differences);
  return result;
}

}  // namespace

std::vector<SummaryRow> summarize(const Study& study, const Outcomes& outcomes) {
  std::vector<SummaryRow> rows;
  for (std::size_t c = 0; c < study.cases.size(); ++c) {
    for (std::size_t p = 0; p < study.policies.size(); ++p) {
      if (outcomes[c][p].empty()) continue;
      rows.push_back(
          summarize_one(study.cases[c], outcomes[c][p], outcomes[c][study.baseline], study.seed));
      rows.back().one_case = c;
      rows.back().policy = p;
    }
  }
  adjust_p_values(study.baseline, rows);
  return rows;
}

std::vector<std::vector<std::string>> case_warnings(const Study& study, const Outcomes& outcomes,
                                                    const std::vector<SummaryRow>& rows) {
  std::vector<std::vector<std::string>> warnings;
  for (const Case& one : study.cases) warnings.push_back(one.findings);
  for (const SummaryRow& row : rows) {
    const std::vector<Outcome>& runs = outcomes[row.one_case][row.policy];
    std::vector<std::string>& of_case = warnings[row.one_case];
    const std::string under = fmt::format("under \"{}\"", study.policies[row.policy].title);
    for (const auto& [text, count] : runs_by_warning(runs)) {
      of_case.push_back(fmt::format("{} in {} of {} runs: {}", under, count, runs.size(), text));
    }
    if (row.left_by_no_exit > 0) {
      of_case.push_back(fmt::format(
          "{} {:.1f} people per run left where there is no exit. They are among the escape times, "
          "but no exit counts them (`throng scenario check` finds gaps in the outline).",
          under, row.left_by_no_exit));
    }
    for (const MeanAtHorizon& at : row.means) {
      if (std::isfinite(at.mean_s)) continue;
      of_case.push_back(
          fmt::format("{} the mean to {:.0f} s is not known: a run ends before anybody has been "
                      "inside for so long, counted from the arrival, or nobody was inside at all.",
                      under, at.at_s));
    }
  }
  return warnings;
}

std::vector<CaseDifference> compare_cases(const Study& study, const Outcomes& outcomes) {
  std::vector<CaseDifference> all;
  if (!study.baseline_case) return all;
  for (std::size_t c = 0; c < study.cases.size(); ++c) {
    if (c == *study.baseline_case) continue;
    for (std::size_t p = 0; p < study.policies.size(); ++p) {
      if (outcomes[c][p].empty() || outcomes[*study.baseline_case][p].empty()) continue;
      for (const int percent : kIntervalPercents) {
        CaseDifference one = case_difference(times_s(outcomes[c][p], percent),
                                             times_s(outcomes[*study.baseline_case][p], percent));
        one.one_case = c;
        one.policy = p;
        one.percent = percent;
        all.push_back(one);
      }
    }
  }
  std::vector<double> p_values;
  p_values.reserve(all.size());
  for (const CaseDifference& one : all) p_values.push_back(one.test.p_value);
  const std::vector<double> adjusted = holm_adjusted(p_values);
  for (std::size_t i = 0; i < all.size(); ++i) all[i].holm_p = adjusted[i];
  return all;
}

Convergence find_convergence(const std::vector<Outcome>& runs, int percent) {
  Convergence result;
  const std::vector<double> times = times_s(runs, percent);
  for (std::size_t count = 2; count <= times.size(); ++count) {
    const std::vector<double> first(times.begin(),
                                    times.begin() + static_cast<std::ptrdiff_t>(count));
    result.mean_s.push_back(mean(first));
    result.mean_95.push_back(student_95(first));
  }
  return result;
}

const EscapePercentile& find_percentile(const SummaryRow& row, int percent) {
  const auto* const found =
      std::find(std::begin(kSummaryPercents), std::end(kSummaryPercents), percent);
  check(found != std::end(kSummaryPercents), "a percentile of the summary");
  return row.percentiles[static_cast<std::size_t>(found - std::begin(kSummaryPercents))];
}

}  // namespace throng::study
