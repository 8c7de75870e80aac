#include "jobs/study/run_report.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <utility>

#include "base/error.h"
#include "base/text/words.h"
#include "base/version.h"
#include "jobs/study/metric_table.h"
#include "jobs/study/page.h"
#include "jobs/study/report_figures.h"

namespace throng::study {

namespace {

std::string time_cell(const std::optional<double>& seconds) {
  return seconds && std::isfinite(*seconds) ? fmt::format("{:.1f}", *seconds) : "not reached";
}

std::string header(const std::string& path, const std::string& name) {
  return "<th>" + definition_link(path, name) + "</th>";
}

std::string runs_table(const std::vector<MeasuredRun>& runs) {
  std::string html = "<table><tr><th>run</th>" + header("people", "people") +
                     header("not_escaped", "not escaped") +
                     header("mean_escape_time_censored_s", "mean escape (s)");
  for (const auto& percentile : runs.front().metrics.percentiles) {
    html += header("escape_time_percentiles.tP_s", fmt::format("T{} (s)", percentile.percent));
  }
  html += header("exit_balance.balance", "balance") + header("exposure", "above 5/m² (person s)") +
          "</tr>\n";
  for (const MeasuredRun& run : runs) {
    html += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td>{:.1f}</td>",
                        escaped_markup(run.name), run.metrics.people, run.metrics.not_escaped,
                        run.metrics.mean_escape_time_s);
    for (const auto& percentile : run.metrics.percentiles) {
      html += fmt::format("<td>{}</td>", time_cell(percentile.time_s));
    }
    html += run.metrics.balance ? fmt::format("<td>{:.2f}</td>", run.metrics.balance->balance)
                                : "<td></td>";
    html += fmt::format("<td>{:.0f}</td></tr>\n",
                        run.metrics.exposure.above_person_s[metrics::kCrushDensityIndex]);
  }
  return html + "</table>\n";
}

/// Whether an exit was closed all the time, so that 0 people are not its figure.
bool was_closed(const metrics::ExitTotals& exit) {
  const double all_s = std::accumulate(exit.state_s.begin(), exit.state_s.end(), 0.0);
  return all_s > 0 && exit.state_s[static_cast<std::size_t>(metrics::ExitState::closed)] == all_s;
}

/// One row per run that adds up to its people.
std::string people_table(const std::vector<MeasuredRun>& runs) {
  std::string html = "<table><tr><th>run</th>" + header("people_counts", "people");
  for (const auto& exit : runs.front().metrics.counts.left_by) {
    html += header("people_counts", "left by " + exit.exit_id);
  }
  for (const char* name : {"by no exit", "inside at the end", "casualties", "vanished inside",
                           "turned back", "never inside"}) {
    html += header("people_counts", name);
  }
  html += "</tr>\n";
  for (const MeasuredRun& run : runs) {
    const metrics::PeopleCounts& counts = run.metrics.counts;
    html += fmt::format("<tr><td>{}</td><td>{}</td>", escaped_markup(run.name), counts.people);
    for (std::size_t e = 0; e < counts.left_by.size(); ++e) {
      const bool is_closed = counts.left_by[e].people == 0 && was_closed(run.metrics.exits[e]);
      html += is_closed ? "<td>closed</td>" : fmt::format("<td>{}</td>", counts.left_by[e].people);
    }
    html += fmt::format("<td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                        counts.left_by_no_exit, counts.inside, counts.casualties,
                        counts.vanished_inside, counts.turned_back, counts.never_inside);
  }
  return html + "</table>\n";
}

/// Each warning once, with the first run that has it and the number of others.
std::string warning_list(const std::vector<MeasuredRun>& runs) {
  std::map<std::string, std::vector<std::string>> runs_of;
  std::vector<std::string> texts;
  for (const MeasuredRun& run : runs) {
    for (const std::string& text : run.warnings) {
      std::vector<std::string>& names = runs_of[text];
      if (names.empty()) texts.push_back(text);
      names.push_back(run.name);
    }
  }
  std::string html;
  for (const std::string& text : texts) {
    const std::vector<std::string>& names = runs_of[text];
    const std::string others =
        names.size() > 1 ? fmt::format(" and {}", counted(names.size() - 1, "other")) : "";
    html += fmt::format("<p class=\"warning\">{}{}: {}.</p>\n", escaped_markup(names.front()),
                        others, escaped_markup(text));
  }
  return html;
}

std::string closed_note(const metrics::ExitTotals& exit) {
  const double closed_s = exit.state_s[static_cast<std::size_t>(metrics::ExitState::closed)];
  if (was_closed(exit)) return " (closed)";
  return closed_s > 0 ? fmt::format(" (closed for {:.1f} s)", closed_s) : "";
}

std::string exits_table(const MeasuredRun& run) {
  static constexpr std::array kColumns = {
      std::pair{"exits[].width_m", "width (m)"},
      std::pair{"exits[].capacity_per_s", "capacity (1/s)"},
      std::pair{"exits[].crossings.out", "crossings out / in"},
      std::pair{"exits[].demand_flow_per_s", "flow with demand (1/s)"},
      std::pair{"exits[].demand_specific_flow_per_ms", "specific (1/(m s))"},
      std::pair{"exits[].demand_s", "demand (s)"},
      std::pair{"exits[].congested_s", "congested (s)"},
      std::pair{"exits[].clogged_s", "clogged (s)"},
      std::pair{"exits[].clogs", "clogs"},
      std::pair{"exits[].mean_clogging_index", "clogging index"},
      std::pair{"exits[].max_queue", "longest queue"},
      std::pair{"exits[].gaps", "longest gap (s)"},
      std::pair{"exits[].max_voronoi_density_per_m2", "max density (1/m²)"},
      std::pair{"exits[].max_pressure_per_s2", "max pressure (1/s²)"}};
  std::string html = "<table><tr><th>exit</th>";
  for (const auto& [path, name] : kColumns) html += header(path, name);
  html += "</tr>\n";
  for (const metrics::ExitTotals& exit : run.metrics.exits) {
    // Without demand the flow is undefined, not 0.
    const auto flow_cell = [&](double per) {
      const auto& flow = exit.demand_flow_per_s;
      return flow ? fmt::format("{:.2f}", *flow / per) : std::string();
    };
    html += fmt::format(
        "<tr><td>{}{}</td><td>{:.2f}</td><td>{:.2f} ({})</td><td>{} / "
        "{}</td><td>{}</td><td>{}</td><td>{:.1f}</td>"
        "<td>{:.1f}</td><td>{:.1f}</td><td>{}</td><td>{:.2f}</td><td>{}</td><td>{}</td>"
        "<td>{:.2f}</td><td>{:.3f}</td></tr>\n",
        escaped_markup(exit.exit_id), closed_note(exit), exit.width_m, exit.capacity_per_s,
        exit.capacity_source, exit.crossings.out, exit.crossings.in, flow_cell(1),
        flow_cell(exit.width_m), exit.demand_s, exit.congested_s, exit.clogged_s, exit.clogs.size(),
        exit.mean_clogging_index, exit.max_queue,
        exit.gaps.max_duration_s ? fmt::format("{:.1f}", *exit.gaps.max_duration_s) : "",
        exit.max_voronoi_density_per_m2, exit.max_pressure_per_s2);
  }
  return html + "</table>\n";
}

/// Style by which only the run that is chosen is shown: a selector that needs no script.
std::string shown_when_chosen(std::size_t runs) {
  if (runs < 2) return "";
  std::string style = "section{display:none}";
  for (std::size_t i = 0; i < runs; ++i) {
    style += fmt::format("#run{0}:checked~#of_run{0}{{display:block}}", i);
  }
  return style + "@media print{section{display:block}}.printing section{display:block}";
}

/// Exits, maps, diagram and paths of one run.
std::string run_section(std::size_t index, const MeasuredRun& run) {
  const auto chart = [&](const std::string& title, const std::string& name) {
    return chart_frame(title, fmt::format("data-chart=\"{}\" data-run=\"{}\"", name, index));
  };
  const auto map = [&](const std::string& title, const std::string& field) {
    return chart_frame(
        title, fmt::format("data-chart=\"map\" data-run=\"{}\" data-field=\"{}\"", index, field));
  };
  const std::string exits =
      run.metrics.exits.empty()
          ? "<p>This scenario has no exits, so that nothing was measured at any.</p>\n"
          : exits_table(run) + chart("State of the exits", "timeline");
  return "<h3>Exits, " + escaped_markup(run.name) + "</h3>\n" + exits + "<h3>Ground, " +
         escaped_markup(run.name) + "</h3>\n" + map("Mean density over the run", "density") +
         map("Greatest crowd pressure (sampled each second)", "pressure") +
         chart("Fundamental diagram", "fundamental") + chart("Paths of the people", "paths");
}

std::string all_runs(const std::vector<MeasuredRun>& runs) {
  std::vector<const metrics::RunMetrics*> figures;
  figures.reserve(runs.size());
  for (const MeasuredRun& run : runs) figures.push_back(&run.metrics);
  return fmt::format("<h2>{}</h2>\n{}{}", runs.size() == 1 ? "Run" : "All runs", people_table(runs),
                     warning_list(runs) + runs_table(runs)) +
         chart_frame("People who have escaped", "data-chart=\"escape\"") + "<h3>Figures</h3>\n" +
         metric_table(figures);
}

}  // namespace

MeasuredRun measured(std::string name, world::Trace trace, const world::Scenario& scenario,
                     std::vector<std::string> warnings) {
  MeasuredRun run{std::move(name), std::move(trace), {}, {}, std::move(warnings)};
  run.exits = metrics::exit_series(run.trace, scenario);
  run.metrics = metrics::run_metrics(run.trace, scenario, run.exits);
  for (std::string& warning : metrics::count_warnings(run.metrics.counts)) {
    run.warnings.push_back(std::move(warning));
  }
  return run;
}

std::string html_report(const world::Scenario& scenario, const std::vector<MeasuredRun>& runs) {
  check(!runs.empty(), "a report has a run");
  Page page;
  page.title = scenario.name.empty() ? scenario.id : scenario.name;
  page.style = shown_when_chosen(runs.size());
  page.body = fmt::format(
      "<h1>{}</h1>\n<p>{}</p>\n<p>{} run{}, {}, definitions version {} (docs/metrics.md). A time "
      "that was not reached before the run ended is called so; the mean escape time counts the "
      "run's end for who was still inside.</p>\n<p class=\"hint\">Charts: a click or the "
      "slider chooses the time of curves and states. Maps and diagrams: point at something to read "
      "its values, click on the legend to hide it, turn the wheel with Ctrl to zoom, drag to "
      "move.</p>\n{}",
      escaped_markup(page.title), escaped_markup(scenario.description), runs.size(),
      runs.size() == 1 ? "" : "s", kGenerator, metrics::kDefinitionsVersion, all_runs(runs));
  if (runs.size() > 1) page.body += "<h2>One run</h2>\n";
  for (std::size_t i = 0; i < runs.size() && runs.size() > 1; ++i) {
    page.body += fmt::format(
        "<input type=\"radio\" name=\"run\" id=\"run{0}\"{1}><label for=\"run{0}\">{2}</label>\n",
        i, i == 0 ? " checked" : "", escaped_markup(runs[i].name));
  }
  for (std::size_t i = 0; i < runs.size(); ++i) {
    page.body +=
        fmt::format("<section id=\"of_run{}\">\n{}</section>\n", i, run_section(i, runs[i]));
  }
  page.body += "<h2>Definitions of the figures</h2>\n" + definition_list();
  return page_html(page, report_figures(scenario, runs));
}

}  // namespace throng::study
