#include "study/report.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "base/files.h"
#include "base/version.h"
#include "study/page.h"

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
  for (const Outcome& run : runs) values.push_back(value(run));
  return values;
}

SummaryRow summarise_one(const std::vector<Outcome>& runs, const std::vector<Outcome>& baseline,
                         std::uint64_t seed) {
  SummaryRow row;
  row.runs = static_cast<int>(runs.size());
  for (const int percent : kSummaryPercents) {
    row.percentiles.push_back(
        spread_of(each(runs, [&](const Outcome& run) { return run.percentile_s(percent); })));
  }
  const auto escape_s = [](const Outcome& run) { return run.mean_escape_s(); };
  row.mean_escape = spread_of(each(runs, escape_s));
  row.mean_escape_mean = mean(each(runs, escape_s));
  row.ratio_to_baseline = row.mean_escape_mean / mean(each(baseline, escape_s));
  std::vector<double> differences;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    differences.push_back(runs[i].mean_escape_s() - baseline[i].mean_escape_s());
    if (runs[i].not_escaped() == 0) ++row.all_out;
  }
  row.difference = mean(differences);
  row.difference_95 = bootstrap_mean(differences, kConfidence, seed);
  row.test = wilcoxon_signed_rank(differences);
  row.t90_to_bound =
      median(each(runs, [](const Outcome& run) { return run.percentile_s(90) / run.bound.t90_s; }));
  row.mean_to_bound =
      median(each(runs, [](const Outcome& run) { return run.mean_escape_s() / run.bound.mean_s; }));
  for (std::size_t e = 0; e < runs.front().exit_use.size(); ++e) {
    row.exit_use.push_back(mean(each(runs, [&](const Outcome& run) { return run.exit_use[e]; })));
  }
  row.followed = mean(each(runs, [](const Outcome& run) { return run.followed; }));
  return row;
}

std::string csv_of(const Study& study, const std::vector<SummaryRow>& rows) {
  std::string csv = "case,policy,runs";
  for (const int percent : kSummaryPercents) {
    csv += fmt::format(",t{0}_median_s,t{0}_low_s,t{0}_high_s", percent);
  }
  csv +=
      ",all_out,mean_median_s,mean_low_s,mean_high_s,mean_mean_s,ratio_to_baseline,difference_s,"
      "difference_low_s,difference_high_s,wilcoxon_p,t90_to_bound,mean_to_bound,followed\n";
  for (const SummaryRow& row : rows) {
    csv += fmt::format("{},{},{}", study.cases[row.one_case].id, study.policies[row.policy].id,
                       row.runs);
    for (const Spread& time : row.percentiles) {
      csv += fmt::format(",{:.2f},{:.2f},{:.2f}", time.median, time.low, time.high);
    }
    csv += fmt::format(
        ",{},{:.3f},{:.3f},{:.3f},{:.3f},{:.4f},{:.3f},{:.3f},{:.3f},{:.3g},{:.3f},"
        "{:.3f},{:.1f}\n",
        row.all_out, row.mean_escape.median, row.mean_escape.low, row.mean_escape.high,
        row.mean_escape_mean, row.ratio_to_baseline, row.difference, row.difference_95.low,
        row.difference_95.high, row.test.p_value, row.t90_to_bound, row.mean_to_bound,
        row.followed);
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

void add_case_table(const Study& study, const std::vector<SummaryRow>& rows, std::size_t one_case,
                    std::string& text) {
  text += fmt::format("\n## {}\n\n", study.cases[one_case].title);
  text +=
      "| policy | T25 | T50 | T75 | T90 | T95 | T99 | all out | mean escape | ratio | difference "
      "[95 %] | p | T90/bound | exits "
      "|\n|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const SummaryRow& row : rows) {
    if (row.one_case != one_case) continue;
    text += fmt::format("| {} |", study.policies[row.policy].title);
    for (const Spread& time : row.percentiles) text += fmt::format(" {} |", spread_text(time));
    text += fmt::format(" {}/{} | {:.1f} [{:.1f}-{:.1f}] |", row.all_out, row.runs,
                        row.mean_escape.median, row.mean_escape.low, row.mean_escape.high);
    if (row.policy == study.baseline) {
      text += " | | |";
    } else {
      text += fmt::format(" {:.2f} | {:+.1f} [{:+.1f}, {:+.1f}] | {:.2g} |", row.ratio_to_baseline,
                          row.difference, row.difference_95.low, row.difference_95.high,
                          row.test.p_value);
    }
    text += fmt::format(" {:.2f} | {} |\n", row.t90_to_bound, exits_text(row));
  }
}

std::string markdown_of(const Study& study, const std::vector<SummaryRow>& rows) {
  std::string text = fmt::format(
      "# {}\n\nMedians [quartiles] over {} runs with paired seeds; times in s from the alarm. Mean "
      "escape: who is not out at the end counts with the end. Ratio, difference, p (Wilcoxon): of "
      "the mean escape to \"{}\", the interval by bootstrap. Bound: docs/guidance.md. Exits: "
      "people "
      "per exit, mean. {}.\n",
      study.name, study.runs, study.policies[study.baseline].title, kGenerator);
  for (std::size_t c = 0; c < study.cases.size(); ++c) add_case_table(study, rows, c, text);
  return text;
}

json time_json(double seconds) { return std::isfinite(seconds) ? json(seconds) : json(nullptr); }

json spread_json(const Spread& time) {
  return {{"median", time_json(time.median)},
          {"low", time_json(time.low)},
          {"high", time_json(time.high)}};
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
    list.push_back(
        {{"case", study.cases[row.one_case].id},
         {"policy", study.policies[row.policy].id},
         {"runs", row.runs},
         {"times", std::move(times)},
         {"all_out", row.all_out},
         {"mean_escape_s", spread_json(row.mean_escape)},
         {"mean_escape_mean_s", row.mean_escape_mean},
         {"ratio_to_baseline", row.ratio_to_baseline},
         {"difference_s", row.difference},
         {"difference_95_s", {row.difference_95.low, row.difference_95.high}},
         {"wilcoxon", {{"n", row.test.n}, {"w_plus", row.test.w_plus}, {"p", row.test.p_value}}},
         {"t90_to_bound", time_json(row.t90_to_bound)},
         {"mean_to_bound", time_json(row.mean_to_bound)},
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
  json share = json::array();
  for (double time_s = 0; time_s <= until_s; time_s += 1) {
    double out = 0;
    for (const Outcome& run : runs) {
      const auto count =
          std::upper_bound(run.escape_s.begin(), run.escape_s.end(), time_s) - run.escape_s.begin();
      out += static_cast<double>(count) / std::max(1, run.people);
    }
    share.push_back(rounded(100 * out / static_cast<double>(runs.size())));
  }
  return {{"name", name}, {"share", std::move(share)}};
}

// Until nearly everybody is out under most policies.
double shown_time_s(const std::vector<std::vector<Outcome>>& policies) {
  constexpr double kRoundTo = 20;
  double longest = 0;
  for (const auto& runs : policies) {
    const double t95 = median(each(runs, [](const Outcome& run) { return run.percentile_s(95); }));
    longest = std::max(longest, std::isfinite(t95) ? t95 : runs.front().duration_s);
  }
  return kRoundTo * std::ceil(1.15 * longest / kRoundTo);
}

std::string html_table(const Study& study, const std::vector<SummaryRow>& rows,
                       std::size_t one_case) {
  std::string html = "<table><tr><th>policy</th>";
  for (const int percent : kSummaryPercents) html += fmt::format("<th>T{} (s)</th>", percent);
  html +=
      "<th>all out (runs)</th><th>mean escape (s)</th><th>ratio</th><th>difference (s)</th>"
      "<th>p</th><th>T90/bound</th><th>exits</th></tr>\n";
  for (const SummaryRow& row : rows) {
    if (row.one_case != one_case) continue;
    html += fmt::format("<tr><td>{}</td>", escaped_markup(study.policies[row.policy].title));
    for (const Spread& time : row.percentiles)
      html += fmt::format("<td>{}</td>", spread_text(time));
    html += fmt::format("<td>{}/{}</td><td>{:.1f} [{:.1f}-{:.1f}]</td>", row.all_out, row.runs,
                        row.mean_escape.median, row.mean_escape.low, row.mean_escape.high);
    html += row.policy == study.baseline
                ? std::string("<td></td><td></td><td></td>")
                : fmt::format("<td>{:.2f}</td><td>{:+.1f} [{:+.1f}, {:+.1f}]</td><td>{:.2g}</td>",
                              row.ratio_to_baseline, row.difference, row.difference_95.low,
                              row.difference_95.high, row.test.p_value);
    html += fmt::format("<td>{:.2f}</td><td>{}</td></tr>\n", row.t90_to_bound, exits_text(row));
  }
  return html + "</table>\n";
}

std::string html_of_study(const Study& study, const Outcomes& outcomes,
                          const std::vector<SummaryRow>& rows) {
  Page page;
  page.title = study.name;
  page.body = fmt::format(
      "<h1>{}</h1>\n<p>{} paired runs of each policy, {}. Times in s from the alarm: medians "
      "[quartiles]; who is not out at the end counts with the end in the mean escape. Ratio, "
      "difference [95 % bootstrap interval] and p (Wilcoxon): of the mean escape to \"{}\". "
      "Bound: docs/guidance.md. Exits: people per exit, mean. Curves: mean over the runs.</p>\n",
      escaped_markup(study.name), study.runs, kGenerator,
      escaped_markup(study.policies[study.baseline].title));
  json cases = json::array();
  for (std::size_t c = 0; c < study.cases.size(); ++c) {
    json curves = json::array();
    const double until_s = shown_time_s(outcomes[c]);
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

std::vector<SummaryRow> summarise(const Study& study, const Outcomes& outcomes) {
  std::vector<SummaryRow> rows;
  for (std::size_t c = 0; c < study.cases.size(); ++c) {
    for (std::size_t p = 0; p < study.policies.size(); ++p) {
      rows.push_back(summarise_one(outcomes[c][p], outcomes[c][study.baseline], study.seed));
      rows.back().one_case = c;
      rows.back().policy = p;
    }
  }
  return rows;
}

void write_report(const Study& study, const Outcomes& outcomes,
                  const std::filesystem::path& folder) {
  const std::vector<SummaryRow> rows = summarise(study, outcomes);
  write_file_atomically(folder / "report.html", html_of_study(study, outcomes, rows));
  write_file_atomically(folder / "summary.csv", csv_of(study, rows));
  write_file_atomically(folder / "summary.json", json_of(study, rows).dump(2) + "\n");
  write_file_atomically(folder / "summary.md", markdown_of(study, rows));
}

}  // namespace throng::study
