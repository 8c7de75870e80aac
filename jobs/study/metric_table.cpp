#include "jobs/study/metric_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <functional>
#include <optional>

#include "base/error.h"
#include "jobs/study/page.h"
#include "jobs/study/statistics.h"
#include "metrics/definitions.h"

namespace throng::study {

namespace {

using metrics::RunMetrics;
using Value = std::optional<double>;

struct MetricRow {
  std::string name;
  std::string path;  ///< in metrics.json, for its definition
  std::string unit;
  std::string meaning;
  std::function<Value(const RunMetrics&)> value;
};

void add_escape_rows(const RunMetrics& example, std::vector<MetricRow>& rows) {
  rows.push_back(
      {"people", "people", "1", "who took part", [](const RunMetrics& run) { return run.people; }});
  rows.push_back({"left by no exit", "people_counts.left_by_no_exit", "1",
                  "left the place where there is no exit",
                  [](const RunMetrics& run) { return run.counts.left_by_no_exit; }});
  rows.push_back({"not escaped", "not_escaped", "1", "still inside and unhurt when the run ended",
                  [](const RunMetrics& run) { return run.not_escaped; }});
  rows.push_back({"casualties", "casualties", "1", "lay hurt when the run ended",
                  [](const RunMetrics& run) { return run.casualties; }});
  rows.push_back({"mean escape time", "mean_escape_time_censored_s", "s",
                  "from the later of alarm and arrival until a person left the place; who did not "
                  "counts until the run's end",
                  [](const RunMetrics& run) { return run.mean_escape_time_s; }});
  for (std::size_t i = 0; i < example.percentiles.size(); ++i) {
    rows.push_back({fmt::format("T{}", example.percentiles[i].percent),
                    "escape_time_percentiles.tP_s", "s",
                    fmt::format("by when {} % had escaped, from the later of alarm and arrival",
                                example.percentiles[i].percent),
                    [i](const RunMetrics& run) { return run.percentiles[i].time_s; }});
  }
  const auto ratio_row = [&](const char* name, const char* path, const char* meaning,
                             std::optional<metrics::BestTimes> RunMetrics::*best) {
    rows.push_back({name, path, "1", meaning, [best](const RunMetrics& run) -> Value {
                      if (!(run.*best)) return std::nullopt;
                      return metrics::ratio_to(*(run.*best), run.escapes, 90);
                    }});
  };
  ratio_row("T90 / lower bound", "lower_bound",
            "bound: each sets out when they noticed, at the greatest speed that they reached, on "
            "the shortest path; doors pass as many as they ever do",
            &RunMetrics::lower_bound);
  ratio_row("T90 / reference time", "reference_time",
            "reference: each sets out when they noticed, at the speed that they desired; doors "
            "pass 1.3 people per meter and second",
            &RunMetrics::reference);
  rows.push_back({"noticed after, median", "notification", "s",
                  "from the later of alarm and arrival until a person knew of the alarm",
                  [](const RunMetrics& run) -> Value {
                    if (!run.notification) return std::nullopt;
                    return metrics::time_by_which(run.notification->notice, 50);
                  }});
}

void add_exit_rows(std::vector<MetricRow>& rows) {
  rows.push_back({"balance of the exits", "exit_balance.balance", "1",
                  "1: used in proportion to their capacities; 0: only exits without capacity",
                  [](const RunMetrics& run) -> Value {
                    if (!run.balance) return std::nullopt;
                    return run.balance->balance;
                  }});
  rows.push_back({"clogged", "exits[].clogged_s", "s",
                  "over all exits: congested, and nobody out for max(2 s, 3 / capacity)",
                  [](const RunMetrics& run) {
                    double sum_s = 0;
                    for (const metrics::ExitTotals& exit : run.exits) sum_s += exit.clogged_s;
                    return sum_s;
                  }});
  rows.push_back({"congested", "exits[].congested_s", "s",
                  "over all exits: at least 0.35 of close packing, approached at less than 0.3 of "
                  "the desired speed; clogs count too",
                  [](const RunMetrics& run) {
                    double sum_s = 0;
                    for (const metrics::ExitTotals& exit : run.exits) sum_s += exit.congested_s;
                    return sum_s;
                  }});
  rows.push_back({"detour, median", "journeys", "1",
                  "distance walked / shortest path to the door used",
                  [](const RunMetrics& run) -> Value {
                    std::vector<double> detours;
                    for (const metrics::Journey& journey : run.journeys) {
                      const Value detour = journey.detour(journey.to_used_m);
                      if (detour) detours.push_back(*detour);
                    }
                    if (detours.empty()) return std::nullopt;
                    return median(detours);
                  }});
}

void add_exposure_rows(std::vector<MetricRow>& rows) {
  for (std::size_t i = 0; i < metrics::kExposureDensities.size(); ++i) {
    rows.push_back({fmt::format("above {} /m²", metrics::kExposureDensities[i]), "exposure",
                    "person s",
                    "time that people were in so dense a crowd, by their own Voronoi cells",
                    [i](const RunMetrics& run) { return run.exposure.above_person_s[i]; }});
  }
  rows.push_back({"greatest density", "exposure.max_density_2m2_per_m2", "1/m²",
                  "mean Voronoi density of a square of 2 m²",
                  [](const RunMetrics& run) { return run.exposure.max_density_per_m2; }});
  rows.push_back({"greatest pressure", "exposure.max_pressure_per_s2", "1/s²",
                  "density times the variance of velocity, mean over a second; compare runs of one "
                  "model only",
                  [](const RunMetrics& run) { return run.exposure.max_pressure_per_s2; }});
  rows.push_back({"turbulent above 5 /m²", "exposure.turbulent_above_5_per_m2_person_s", "person s",
                  "in so dense a crowd while the pressure is above 0.02 /s² (crowd turbulence)",
                  [](const RunMetrics& run) { return run.exposure.turbulent_5_person_s; }});
  rows.push_back({"led by drones", "guidance", "1", "people who followed at some time",
                  [](const RunMetrics& run) { return run.guidance.led; }});
}

}  // namespace

std::string definition_link(const std::string& path, const std::string& name) {
  const metrics::Definition* definition = metrics::find_definition(path);
  check(definition != nullptr, "every figure of a report has a definition");
  return fmt::format("<a href=\"#def-{}\">{}</a>", definition->anchor, escaped_markup(name));
}

std::string definition_list() {
  std::string html = "<dl class=\"definitions\">\n";
  for (const metrics::Definition& definition : metrics::definitions_of_run()) {
    html += fmt::format("<dt id=\"def-{}\">{}</dt><dd>{} <span class=\"hint\">({})</span></dd>\n",
                        definition.anchor,
                        escaped_markup(fmt::format("{}", fmt::join(definition.paths, ", "))),
                        escaped_markup(definition.text), anchor_address(definition));
  }
  return html + "</dl>\n";
}

std::string metric_table(const std::vector<const RunMetrics*>& runs) {
  std::vector<MetricRow> rows;
  add_escape_rows(*runs.front(), rows);
  add_exit_rows(rows);
  add_exposure_rows(rows);
  std::string html =
      "<table><tr><th class=\"text\">figure</th><th class=\"text\">unit</th><th "
      "class=\"text\">meaning</th><th>median</th>"
      "<th>quartiles</th><th>runs</th></tr>\n";
  for (const MetricRow& row : rows) {
    std::vector<double> values;
    for (const RunMetrics* run : runs) {
      const Value value = row.value(*run);
      if (value && std::isfinite(*value)) values.push_back(*value);
    }
    html += fmt::format("<tr><td>{}</td><td class=\"text\">{}</td><td class=\"text\">{}</td>",
                        definition_link(row.path, row.name), row.unit, escaped_markup(row.meaning));
    if (values.empty()) {
      html += "<td>none</td><td></td><td>0</td></tr>\n";
      continue;
    }
    // A single run has no quartiles.
    const std::string quartiles =
        values.size() < 2
            ? ""
            : fmt::format("{:.4g} to {:.4g}", quantile(values, 0.25), quantile(values, 0.75));
    html += fmt::format("<td>{:.4g}</td><td>{}</td><td>{}</td></tr>\n", median(values), quartiles,
                        values.size());
  }
  return html + "</table>\n";
}

}  // namespace throng::study
