#include "jobs/study/report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "base/files/files.h"
#include "base/version.h"
#include "jobs/study/page.h"
#include "jobs/study/summary_tables.h"
#include "jobs/study/values.h"

namespace throng::study {

using nlohmann::json;

namespace {

constexpr const char* kIntervalTitle = "Intervals";
constexpr const char* kDifferenceTitle = "Cases compared";
constexpr int kConvergencePercent = 95;

/// Everything that the report's files say.
struct Summary {
  std::vector<SummaryRow> rows;
  std::vector<CaseDifference> case_differences;
  std::vector<std::vector<std::string>> warnings;  ///< per case
};

Summary make_summary(const Study& study, const Outcomes& outcomes) {
  std::vector<SummaryRow> rows = summarize(study, outcomes);
  auto warnings = case_warnings(study, outcomes, rows);
  return {std::move(rows), compare_cases(study, outcomes), std::move(warnings)};
}

/// A field of CSV in quotes.
std::string quoted(const std::string& text) {
  std::string field = "\"";
  for (const char letter : text) field += letter == '"' ? "\"\"" : std::string(1, letter);
  return field + "\"";
}

/// A figure with some digits; empty if it is not known.
std::string known(double value, int digits) {
  return std::isnan(value) ? "" : fmt::format("{:.{}f}", value, digits);
}

std::string summary_csv(const Study& study, const Summary& summary) {
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
  csv += ",t90_to_bound,mean_to_bound,t90_to_reference,mean_to_reference,followed";
  for (const int percent : kIntervalPercents) {
    csv += fmt::format(
        ",t{0}_mean_s,t{0}_mean_low_s,t{0}_mean_high_s,t{0}_p95_s,t{0}_p95_low_s,t{0}_p95_high_s",
        percent);
  }
  csv += ",warnings\n";
  for (const SummaryRow& row : summary.rows) {
    csv += fmt::format("{},{},{}", study.cases[row.one_case].id, study.policies[row.policy].id,
                       row.runs);
    for (const EscapePercentile& time : row.percentiles) {
      csv += fmt::format(",{:.2f},{:.2f},{:.2f}", time.spread.median, time.spread.low,
                         time.spread.high);
    }
    csv += fmt::format(",{},{:.2f},{:.2f}", row.all_out, row.not_escaped, row.casualties);
    for (const MeanAtHorizon& at : row.means) {
      const auto p_value = [](double p) { return std::isnan(p) ? "" : fmt::format("{:.3g}", p); };
      csv += fmt::format(
          ",{:.6g},{},{},{},{},{:.2f},{},{},{},{},{},{}", at.at_s, known(at.spread.median, 3),
          known(at.spread.low, 3), known(at.spread.high, 3), known(at.mean_s, 3), at.inside,
          known(at.ratio_to_baseline, 4), known(at.difference_s, 3), known(at.difference_95.low, 3),
          known(at.difference_95.high, 3), p_value(at.test.p_value), p_value(at.holm_p));
    }
    csv += fmt::format(",{:.3f},{:.3f},{:.3f},{:.3f},{:.1f}", row.t90_to_bound, row.mean_to_bound,
                       row.t90_to_reference, row.mean_to_reference, row.followed);
    for (const int percent : kIntervalPercents) {
      const EscapePercentile& time = find_percentile(row, percent);
      for (const double value : {time.mean_s, time.mean_95.low, time.mean_95.high, time.high_s,
                                 time.high_95.low, time.high_95.high}) {
        csv += "," + known(value, 2);
      }
    }
    csv += "," + quoted(fmt::format("{}", fmt::join(summary.warnings[row.one_case], "; "))) + "\n";
  }
  return csv;
}

std::string markdown_row(const std::vector<std::string>& cells) {
  std::string text = "|";
  for (const std::string& cell : cells) text += fmt::format(" {} |", cell);
  return text + "\n";
}

std::string markdown_table(const Table& table) {
  std::string text = markdown_row(table.header);
  text += markdown_row(std::vector<std::string>(table.header.size(), "---"));
  for (const std::vector<std::string>& cells : table.rows) text += markdown_row(cells);
  return text;
}

std::string report_markdown(const Study& study, const Summary& summary) {
  std::string text =
      fmt::format("# {}\n\n{} {}.\n", study.name, case_explanation(study), kGenerator);
  for (std::size_t c = 0; c < study.cases.size(); ++c) {
    text += fmt::format("\n## {}\n\n", study.cases[c].title) +
            markdown_table(case_table(study, summary.rows, c));
    for (const std::string& warning : summary.warnings[c]) {
      text += "\nWarning: " + warning + "\n";
    }
  }
  text += fmt::format("\n## {}\n\n{}\n\n", kIntervalTitle, interval_explanation()) +
          markdown_table(interval_table(study, summary.rows));
  if (summary.case_differences.empty()) return text;
  return text +
         fmt::format("\n## {}\n\n{}\n\n", kDifferenceTitle, case_difference_explanation(study)) +
         markdown_table(case_difference_table(study, summary.case_differences));
}

json time_json(double seconds) { return std::isfinite(seconds) ? json(seconds) : json(nullptr); }

json spread_json(const Spread& time) {
  return {{"median", time_json(time.median)},
          {"low", time_json(time.low)},
          {"high", time_json(time.high)}};
}

json interval_json(const Interval& interval) {
  return {time_json(interval.low), time_json(interval.high)};
}

json percentile_json(const EscapePercentile& time) {
  json value = spread_json(time.spread);
  value["mean_s"] = time_json(time.mean_s);
  value["mean_95_s"] = interval_json(time.mean_95);
  value["p95_s"] = time_json(time.high_s);
  value["p95_95_s"] = interval_json(time.high_95);
  value["runs_for_5_percent"] = time_json(time.runs_for_5_percent);
  return value;
}

json case_difference_json(const Study& study, const CaseDifference& one) {
  return {{"case", study.cases[one.one_case].id},
          {"policy", study.policies[one.policy].id},
          {"percent", one.percent},
          {"runs", one.runs},
          {"difference_s", time_json(one.difference_s)},
          {"difference_95_s", interval_json(one.difference_95)},
          {"wilcoxon",
           {{"n", one.test.n}, {"w_plus", one.test.w_plus}, {"p", time_json(one.test.p_value)}}},
          {"holm_p", time_json(one.holm_p)}};
}

json mean_json(const MeanAtHorizon& at) {
  return {{"until_s", at.at_s},
          {"restricted_mean_s", spread_json(at.spread)},
          {"mean_s", time_json(at.mean_s)},
          {"inside", at.inside},
          {"ratio_to_baseline", time_json(at.ratio_to_baseline)},
          {"difference_s", time_json(at.difference_s)},
          {"difference_95_s", {time_json(at.difference_95.low), time_json(at.difference_95.high)}},
          {"wilcoxon",
           {{"n", at.test.n}, {"w_plus", at.test.w_plus}, {"p", time_json(at.test.p_value)}}},
          {"holm_p", time_json(at.holm_p)}};
}

json report_json(const Study& study, const Summary& summary) {
  json list = json::array();
  for (const SummaryRow& row : summary.rows) {
    json times;
    for (std::size_t i = 0; i < row.percentiles.size(); ++i) {
      times[fmt::format("t{}_s", kSummaryPercents[i])] = percentile_json(row.percentiles[i]);
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
                    {"exit_use", std::move(exits)},
                    {"left_by_no_exit", row.left_by_no_exit}});
  }
  json warnings = json::array();
  for (std::size_t c = 0; c < study.cases.size(); ++c) {
    for (const std::string& text : summary.warnings[c]) {
      warnings.push_back({{"case", study.cases[c].id}, {"text", text}});
    }
  }
  json document = {{"name", study.name},      {"seed", study.seed},
                   {"generator", kGenerator}, {"baseline", study.policies[study.baseline].id},
                   {"rows", std::move(list)}, {"warnings", std::move(warnings)}};
  if (!study.baseline_case) return document;
  document["baseline_case"] = study.cases[*study.baseline_case].id;
  document["case_differences"] = json::array();
  for (const CaseDifference& one : summary.case_differences) {
    document["case_differences"].push_back(case_difference_json(study, one));
  }
  return document;
}

// Share of people out at each second in per cent, mean over the runs.
json curve_json(const std::string& name, const std::vector<Outcome>& runs, double until_s) {
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

double median_t95_s(const std::vector<Outcome>& runs) {
  std::vector<double> times_s(runs.size());
  std::transform(runs.begin(), runs.end(), times_s.begin(),
                 [](const Outcome& run) { return run.percentile_s(95); });
  return median(times_s);
}

// Until nearly everybody is out under most policies.
double shown_time_s(const Case& one, const std::vector<std::vector<Outcome>>& policies) {
  constexpr double kRoundTo = 20;
  double longest = 0;
  for (const auto& runs : policies) {
    const double t95 = median_t95_s(runs);
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

std::string html_table(const Table& table) {
  std::string html = "<table>" + html_row("th", table.header);
  for (const std::vector<std::string>& cells : table.rows) html += html_row("td", cells);
  return html + "</table>\n";
}

/// How the mean settles as runs are added, of each policy in a case.
json convergence_json(const Study& study, const std::vector<std::vector<Outcome>>& policies) {
  json curves = json::array();
  for (std::size_t p = 0; p < policies.size(); ++p) {
    const Convergence settled = find_convergence(policies[p], kConvergencePercent);
    json mean_s = json::array();
    json low_s = json::array();
    json high_s = json::array();
    for (std::size_t i = 0; i < settled.mean_s.size(); ++i) {
      mean_s.push_back(rounded(settled.mean_s[i]));
      low_s.push_back(rounded(settled.mean_95[i].low));
      high_s.push_back(rounded(settled.mean_95[i].high));
    }
    curves.push_back({{"name", study.policies[p].title},
                      {"mean_s", std::move(mean_s)},
                      {"low_s", std::move(low_s)},
                      {"high_s", std::move(high_s)}});
  }
  return curves;
}

std::string html_section(const char* title, const std::string& explanation, const Table& table) {
  return fmt::format("<h2>{}</h2>\n<p>{}</p>\n", title, escaped_markup(explanation)) +
         html_table(table);
}

/// All cases in one chart.
json all_curves(const Study& study, const Outcomes& outcomes) {
  double until_s = 0;
  for (std::size_t c = 0; c < study.cases.size(); ++c) {
    until_s = std::max(until_s, shown_time_s(study.cases[c], outcomes[c]));
  }
  json curves = json::array();
  for (std::size_t c = 0; c < study.cases.size(); ++c) {
    for (std::size_t p = 0; p < study.policies.size(); ++p) {
      std::string name = study.cases[c].title;
      if (study.policies.size() > 1) name += ", " + study.policies[p].title;
      curves.push_back(curve_json(name, outcomes[c][p], until_s));
    }
  }
  return {{"curves", std::move(curves)}, {"convergence", json::array()}};
}

std::string html_of_study(const Study& study, const Outcomes& outcomes, const Summary& summary) {
  Page page;
  page.title = study.name;
  page.body =
      fmt::format("<h1>{}</h1>\n<p>{} {}. Curves: mean over the runs.</p>\n",
                  escaped_markup(study.name), escaped_markup(case_explanation(study)), kGenerator);
  json cases = json::array();
  if (study.cases.size() > 1) {
    page.body += "<h2>All cases</h2>\n" +
                 chart_frame("People out", fmt::format("data-chart=\"policies\" data-case=\"{}\"",
                                                       study.cases.size()));
  }
  for (std::size_t c = 0; c < study.cases.size(); ++c) {
    json curves = json::array();
    const double until_s = shown_time_s(study.cases[c], outcomes[c]);
    for (std::size_t p = 0; p < study.policies.size(); ++p) {
      curves.push_back(curve_json(study.policies[p].title, outcomes[c][p], until_s));
    }
    cases.push_back(
        {{"curves", std::move(curves)}, {"convergence", convergence_json(study, outcomes[c])}});
    page.body += fmt::format("<h2>{}</h2>\n", escaped_markup(study.cases[c].title)) +
                 html_table(case_table(study, summary.rows, c));
    for (const std::string& warning : summary.warnings[c]) {
      page.body += fmt::format("<p class=\"warning\">Warning: {}</p>\n", escaped_markup(warning));
    }
    page.body +=
        chart_frame("People out", fmt::format("data-chart=\"policies\" data-case=\"{}\"", c));
    if (study.runs < 2) continue;
    page.body += chart_frame(
        fmt::format("Mean T{} over the first runs, with its 95 % interval", kConvergencePercent),
        fmt::format("data-chart=\"convergence\" data-case=\"{}\"", c));
  }
  page.body +=
      html_section(kIntervalTitle, interval_explanation(), interval_table(study, summary.rows));
  if (!summary.case_differences.empty()) {
    page.body += html_section(kDifferenceTitle, case_difference_explanation(study),
                              case_difference_table(study, summary.case_differences));
  }
  if (study.cases.size() > 1) cases.push_back(all_curves(study, outcomes));
  return page_html(page, {{"cases", std::move(cases)}});
}

}  // namespace

json summary_json(const Study& study, const Outcomes& outcomes) {
  return report_json(study, make_summary(study, outcomes));
}

void write_report(const Study& study, const Outcomes& outcomes,
                  const std::filesystem::path& folder) {
  const Summary summary = make_summary(study, outcomes);
  write_file_atomically(folder / kReportName, html_of_study(study, outcomes, summary));
  write_file_atomically(folder / kCsvName, summary_csv(study, summary));
  write_file_atomically(folder / kMarkdownName, report_markdown(study, summary));
  write_file_atomically(folder / kValuesName, values_json(study, all_runs(outcomes)).dump() + "\n");
  write_file_atomically(folder / kSummaryName, report_json(study, summary).dump(2) + "\n");
}

}  // namespace throng::study
