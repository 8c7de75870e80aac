#include "study/report.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "base/files.h"
#include "base/version.h"
#include "study/page.h"
#include "study/values.h"

namespace throng::study {

using nlohmann::json;

namespace {

constexpr double kConfidence = 0.95;

Spread spread_of(const std::vector<double>& values) {
  return {median(values), quantile(values, 0.25), quantile(values, 0.75)};
}

template <typename Value>
std::vector<double> each(const std::vector<Outcome>& runs, const Value& value) {
  std::vector<double> values;
  values.reserve(runs.size());
  for (const Outcome& run : runs) values.push_back(value(run));
  return values;
}

MeanAtHorizon mean_at(double at_s, const std::vector<Outcome>& runs,
                      const std::vector<Outcome>& baseline, std::uint64_t seed) {
  const auto mean_s = [at_s](const Outcome& run) { return run.restricted_mean_s(at_s); };
  MeanAtHorizon result;
  result.at_s = at_s;
  result.spread = spread_of(each(runs, mean_s));
  result.mean_s = mean(each(runs, mean_s));
  result.inside = mean(
      each(runs, [at_s](const Outcome& run) -> double { return run.escapes.inside_after(at_s); }));
  result.ratio_to_baseline = result.mean_s / mean(each(baseline, mean_s));
  std::vector<double> differences;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    differences.push_back(mean_s(runs[i]) - mean_s(baseline[i]));
  }
  result.difference_s = mean(differences);
  result.difference_95 = bootstrap_mean(differences, kConfidence, seed);
  result.test = wilcoxon_signed_rank(differences);
  return result;
}

SummaryRow summarize_one(const Case& one, const std::vector<Outcome>& runs,
                         const std::vector<Outcome>& baseline, std::uint64_t seed) {
  SummaryRow row;
  row.runs = static_cast<int>(runs.size());
  for (const int percent : kSummaryPercents) {
    row.percentiles.push_back(
        spread_of(each(runs, [&](const Outcome& run) { return run.percentile_s(percent); })));
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
  for (std::size_t e = 0; e < runs.front().exit_use.size(); ++e) {
    row.exit_use.push_back(mean_of(
        [&](const Outcome& run) -> double { return run.exit_use[e].out - run.exit_use[e].in; }));
  }
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

std::string csv_of(const Study& study, const std::vector<SummaryRow>& rows) {
  std::string csv = "case,policy,runs";
  for (const int percent : kSummaryPercents) {
    csv += fmt::format(",t{0}_median_s,t{0}_low_s,t{0}_high_s", percent);
  }
  csv += ",all_out,not_escaped,casualties";
  for (const char* name : {"rmst1", "rmst2"}) {
    csv += fmt::format(
        ",{0}_until_s,{0}_median_s,{0}_low_s,{0}_high_s,{0}_mean_s,{0}_inside,"
        "{0}_ratio_to_baseline,{0}_difference_s,{0}_difference_low_s,{0}_difference_high_s,"
        "{0}_wilcoxon_p,{0}_holm_p",
        name);
  }
  csv += ",t90_to_bound,mean_to_bound,t90_to_reference,mean_to_reference,followed\n";
  for (const SummaryRow& row : rows) {
    csv += fmt::format("{},{},{}", study.cases[row.one_case].id, study.policies[row.policy].id,
                       row.runs);
    for (const Spread& time : row.percentiles) {
      csv += fmt::format(",{:.2f},{:.2f},{:.2f}", time.median, time.low, time.high);
    }
    csv += fmt::format(",{},{:.2f},{:.2f}", row.all_out, row.not_escaped, row.casualties);
    for (const MeanAtHorizon& at : row.means) {
      csv += fmt::format(
          ",{:.6g},{:.3f},{:.3f},{:.3f},{:.3f},{:.2f},{:.4f},{:.3f},{:.3f},{:.3f},{:.3g},{:.3g}",
          at.at_s, at.spread.median, at.spread.low, at.spread.high, at.mean_s, at.inside,
          at.ratio_to_baseline, at.difference_s, at.difference_95.low, at.difference_95.high,
          at.test.p_value, at.holm_p);
    }
    csv += fmt::format(",{:.3f},{:.3f},{:.3f},{:.3f},{:.1f}\n", row.t90_to_bound, row.mean_to_bound,
                       row.t90_to_reference, row.mean_to_reference, row.followed);
  }
  return csv;
}

std::string time_text(double seconds) {
  return std::isfinite(seconds) ? fmt::format("{:.0f}", seconds) : std::string("never");
}

std::string spread_text(const Spread& time) {
  return fmt::format("{} [{}-{}]", time_text(time.median), time_text(time.low),
                     time_text(time.high));
}

std::string exits_text(const SummaryRow& row) {
  std::string text;
  for (const double count : row.exit_use)
    text += fmt::format("{}{:.0f}", text.empty() ? "" : "/", count);
  return text;
}

/// A cell of the case's table, in Markdown and in HTML alike.
std::vector<std::string> case_header(const Case& one) {
  std::vector<std::string> cells = {"policy"};
  for (const int percent : kSummaryPercents) cells.push_back(fmt::format("T{}", percent));
  cells.insert(cells.end(), {"all out", "left inside"});
  for (const double at_s : one.horizons_s) {
    cells.insert(cells.end(), {fmt::format("mean to {:.0f} s", at_s), "ratio", "difference [95 %]",
                               "p", "p (Holm)"});
  }
  cells.insert(cells.end(), {"T90/bound", "T90/reference", "exits"});
  return cells;
}

std::vector<std::string> case_cells(const Study& study, const SummaryRow& row) {
  std::vector<std::string> cells = {study.policies[row.policy].title};
  for (const Spread& time : row.percentiles) cells.push_back(spread_text(time));
  cells.push_back(fmt::format("{}/{}", row.all_out, row.runs));
  cells.push_back(fmt::format("{:.1f}", row.not_escaped));
  for (const MeanAtHorizon& at : row.means) {
    cells.push_back(
        fmt::format("{:.1f} [{:.1f}-{:.1f}]", at.spread.median, at.spread.low, at.spread.high));
    if (row.policy == study.baseline) {
      cells.insert(cells.end(), {"", "", "", ""});
      continue;
    }
    cells.push_back(fmt::format("{:.2f}", at.ratio_to_baseline));
    cells.push_back(fmt::format("{:+.1f} [{:+.1f}, {:+.1f}]", at.difference_s, at.difference_95.low,
                                at.difference_95.high));
    cells.push_back(fmt::format("{:.2g}", at.test.p_value));
    cells.push_back(fmt::format("{:.2g}", at.holm_p));
  }
  cells.push_back(fmt::format("{:.2f}", row.t90_to_bound));
  cells.push_back(fmt::format("{:.2f}", row.t90_to_reference));
  cells.push_back(exits_text(row));
  return cells;
}

std::string markdown_row(const std::vector<std::string>& cells) {
  std::string text = "|";
  for (const std::string& cell : cells) text += fmt::format(" {} |", cell);
  return text + "\n";
}

std::string explanation(const Study& study) {
  return fmt::format(
      "Medians [quartiles] over {} runs with paired seeds; times in s, each person's from the "
      "later of alarm and arrival. Mean to a horizon: restricted mean survival time, who is not "
      "out by then counts with it. Ratio, difference and p (Wilcoxon): of that mean to \"{}\", the "
      "interval by bootstrap; p (Holm): adjusted for all comparisons of the study. Left inside: "
      "unhurt at the end, mean. Bound, reference: docs/guidance.md. Exits: net number of people "
      "out per exit, mean.",
      study.runs, study.policies[study.baseline].title);
}

std::string markdown_of(const Study& study, const std::vector<SummaryRow>& rows) {
  std::string text = fmt::format("# {}\n\n{} {}.\n", study.name, explanation(study), kGenerator);
  for (std::size_t c = 0; c < study.cases.size(); ++c) {
    const std::vector<std::string> header = case_header(study.cases[c]);
    text += fmt::format("\n## {}\n\n", study.cases[c].title) + markdown_row(header);
    text += markdown_row(std::vector<std::string>(header.size(), "---"));
    for (const SummaryRow& row : rows) {
      if (row.one_case == c) text += markdown_row(case_cells(study, row));
    }
  }
  return text;
}

json time_json(double seconds) { return std::isfinite(seconds) ? json(seconds) : json(nullptr); }

json spread_json(const Spread& time) {
  return {{"median", time_json(time.median)},
          {"low", time_json(time.low)},
          {"high", time_json(time.high)}};
}

json mean_json(const MeanAtHorizon& at) {
  return {{"until_s", at.at_s},
          {"restricted_mean_s", spread_json(at.spread)},
          {"mean_s", time_json(at.mean_s)},
          {"inside", at.inside},
          {"ratio_to_baseline", time_json(at.ratio_to_baseline)},
          {"difference_s", time_json(at.difference_s)},
          {"difference_95_s", {time_json(at.difference_95.low), time_json(at.difference_95.high)}},
          {"wilcoxon", {{"n", at.test.n}, {"w_plus", at.test.w_plus}, {"p", at.test.p_value}}},
          {"holm_p", time_json(at.holm_p)}};
}

json json_of(const Study& study, const std::vector<SummaryRow>& rows) {
  json list = json::array();
  for (const SummaryRow& row : rows) {
    json times;
    for (std::size_t i = 0; i < row.percentiles.size(); ++i) {
      times[fmt::format("t{}_s", kSummaryPercents[i])] = spread_json(row.percentiles[i]);
    }
    json exits;
    const auto& scenario_exits = study.cases[row.one_case].scenario.exits;
    for (std::size_t e = 0; e < row.exit_use.size(); ++e)
      exits[scenario_exits[e].id] = row.exit_use[e];
    json means = json::array();
    for (const MeanAtHorizon& at : row.means) means.push_back(mean_json(at));
    list.push_back({{"case", study.cases[row.one_case].id},
                    {"policy", study.policies[row.policy].id},
                    {"runs", row.runs},
                    {"times", std::move(times)},
                    {"all_out", row.all_out},
                    {"not_escaped", row.not_escaped},
                    {"casualties", row.casualties},
                    {"restricted_means", std::move(means)},
                    {"t90_to_bound", time_json(row.t90_to_bound)},
                    {"mean_to_bound", time_json(row.mean_to_bound)},
                    {"t90_to_reference", time_json(row.t90_to_reference)},
                    {"mean_to_reference", time_json(row.mean_to_reference)},
                    {"followed", row.followed},
                    {"exit_use", std::move(exits)}});
  }
  return {{"name", study.name},
          {"seed", study.seed},
          {"generator", kGenerator},
          {"baseline", study.policies[study.baseline].id},
          {"rows", std::move(list)}};
}

// Share of people out at each second in per cent, mean over the runs.
json curve_of(const std::string& name, const std::vector<Outcome>& runs, double until_s) {
  const auto seconds = static_cast<std::size_t>(until_s);
  std::vector<double> sum(seconds + 1, 0);
  for (const Outcome& run : runs) {
    const std::vector<double> curve = run.escapes.curve();
    for (std::size_t second = 0; second <= seconds; ++second) {
      sum[second] += curve[std::min(second, curve.size() - 1)];
    }
  }
  json share = json::array();
  for (const double out : sum)
    share.push_back(rounded(100 * out / static_cast<double>(runs.size())));
  return {{"name", name}, {"share", std::move(share)}};
}

// Until nearly everybody is out under most policies.
double shown_time_s(const Case& one, const std::vector<std::vector<Outcome>>& policies) {
  constexpr double kRoundTo = 20;
  double longest = 0;
  for (const auto& runs : policies) {
    const double t95 = median(each(runs, [](const Outcome& run) { return run.percentile_s(95); }));
    longest = std::max(longest, std::isfinite(t95) ? t95 : one.duration_s);
  }
  return kRoundTo * std::ceil(1.15 * longest / kRoundTo);
}

std::string html_row(const char* tag, const std::vector<std::string>& cells) {
  std::string html = "<tr>";
  for (const std::string& cell : cells) {
    html += fmt::format("<{0}>{1}</{0}>", tag, escaped_markup(cell));
  }
  return html + "</tr>\n";
}

std::string html_table(const Study& study, const std::vector<SummaryRow>& rows,
                       std::size_t one_case) {
  std::string html = "<table>" + html_row("th", case_header(study.cases[one_case]));
  for (const SummaryRow& row : rows) {
    if (row.one_case == one_case) html += html_row("td", case_cells(study, row));
  }
  return html + "</table>\n";
}

std::string html_of_study(const Study& study, const Outcomes& outcomes,
                          const std::vector<SummaryRow>& rows) {
  Page page;
  page.title = study.name;
  page.body =
      fmt::format("<h1>{}</h1>\n<p>{} {}. Curves: mean over the runs.</p>\n",
                  escaped_markup(study.name), escaped_markup(explanation(study)), kGenerator);
  json cases = json::array();
  for (std::size_t c = 0; c < study.cases.size(); ++c) {
    json curves = json::array();
    const double until_s = shown_time_s(study.cases[c], outcomes[c]);
    for (std::size_t p = 0; p < study.policies.size(); ++p) {
      curves.push_back(curve_of(study.policies[p].title, outcomes[c][p], until_s));
    }
    cases.push_back({{"curves", std::move(curves)}});
    page.body +=
        fmt::format("<h2>{}</h2>\n", escaped_markup(study.cases[c].title)) +
        html_table(study, rows, c) +
        chart_frame("People out", fmt::format("data-chart=\"policies\" data-case=\"{}\"", c));
  }
  return html_of(page, {{"cases", std::move(cases)}});
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

json summary_json(const Study& study, const Outcomes& outcomes) {
  return json_of(study, summarize(study, outcomes));
}

void write_report(const Study& study, const Outcomes& outcomes,
                  const std::filesystem::path& folder) {
  const std::vector<SummaryRow> rows = summarize(study, outcomes);
  write_file_atomically(folder / kReportName, html_of_study(study, outcomes, rows));
  write_file_atomically(folder / kCsvName, csv_of(study, rows));
  write_file_atomically(folder / kMarkdownName, markdown_of(study, rows));
  write_file_atomically(folder / kValuesName, values_json(study, all_runs(outcomes)).dump() + "\n");
  write_file_atomically(folder / kSummaryName, json_of(study, rows).dump(2) + "\n");
}

}  // namespace throng::study
