#include "study/run_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>

#include "base/error.h"
#include "base/version.h"
#include "metrics/near_people.h"
#include "metrics/point_grid.h"
#include "metrics/pressure.h"
#include "metrics/voronoi.h"
#include "study/plot.h"
#include "study/statistics.h"

namespace throng::study {

using Eigen::Vector2d;

namespace {

// Colours by Okabe and Ito (2008), from calm to alarm.
constexpr std::array kStateColours{"#e8e8e8", "#009E73", "#E69F00", "#D55E00", "#000000"};
constexpr const char* kRunColour = "#0072B2";
constexpr const char* kWallColour = "#9a9a9a";
constexpr double kMapCellM = 1.0;
constexpr std::size_t kMostDots = 4000;

std::size_t steps_per_second(const world::Trace& trace) {
  return static_cast<std::size_t>(std::max<long>(1, std::lround(1 / trace.header.dt_s)));
}

std::string escape_chart(const std::vector<MeasuredRun>& runs) {
  std::size_t seconds = 0;
  for (const MeasuredRun& run : runs) seconds = std::max(seconds, run.metrics.escape_curve.size());
  Plot plot({"People who have escaped", "time (s)", "share (%)"},
            {0, static_cast<double>(seconds) - 1}, {0, 100});
  std::vector<Vector2d> middle, band, lower;
  for (std::size_t second = 0; second < seconds; ++second) {
    std::vector<double> shares;
    for (const MeasuredRun& run : runs) {
      const std::vector<double>& curve = run.metrics.escape_curve;
      if (!curve.empty()) shares.push_back(100 * curve[std::min(second, curve.size() - 1)]);
    }
    const auto at = static_cast<double>(second);
    middle.emplace_back(at, median(shares));
    band.emplace_back(at, quantile(shares, 0.75));
    lower.emplace_back(at, quantile(shares, 0.25));
  }
  band.insert(band.end(), lower.rbegin(), lower.rend());
  if (runs.size() > 1) plot.area(band, "#56B4E9", 0.35);
  for (const MeasuredRun& run : runs) {
    std::vector<Vector2d> points;
    for (std::size_t i = 0; i < run.metrics.escape_curve.size(); ++i) {
      points.emplace_back(i, 100 * run.metrics.escape_curve[i]);
    }
    plot.line(points, "#888888", 0.8, 0.6);
  }
  plot.line(middle, kRunColour, 2.5);
  plot.legend(runs.size() > 1 ? "median" : "the run", kRunColour);
  if (runs.size() > 1) {
    plot.legend("quartiles", "#56B4E9");
    plot.legend("runs", "#888888");
  }
  return plot.svg();
}

std::string timeline_chart(const MeasuredRun& run) {
  const auto rows = static_cast<double>(run.exits.size());
  Plot plot({"State of the exits, " + run.name, "time (s)", ""}, {0, run.trace.duration_s()},
            {0, rows});
  for (std::size_t e = 0; e < run.exits.size(); ++e) {
    const double low = rows - static_cast<double>(e) - 0.85;
    plot.row_name(low + 0.35, run.exits[e].exit_id);
    const auto& samples = run.exits[e].samples;
    for (std::size_t from = 0; from < samples.size();) {
      std::size_t to = from;
      while (to < samples.size() && samples[to].state == samples[from].state) ++to;
      const double end_s = run.trace.time_s[std::min(to, samples.size() - 1)];
      plot.tile({run.trace.time_s[from], low}, {end_s, low + 0.7},
                kStateColours[static_cast<std::size_t>(samples[from].state)]);
      from = to;
    }
  }
  for (std::size_t i = 0; i < kStateColours.size(); ++i) {
    plot.legend(metrics::name_of(static_cast<metrics::ExitState>(i)), kStateColours[i]);
  }
  return plot.svg();
}

// White over yellow and red to black, for 0 to 1.
std::string heat(double share) {
  const double at = std::clamp(share, 0.0, 1.0);
  const auto part = [](double value) {
    return static_cast<int>(std::lround(255 * std::clamp(value, 0.0, 1.0)));
  };
  return fmt::format("#{:02x}{:02x}{:02x}", part(2.6 - 2.2 * at), part(1.25 - 1.5 * at),
                     part(1 - 3 * at));
}

// Values on a grid of metres over Scenario::inside.
struct FieldMap {
  Vector2d origin;
  int columns = 0;
  int rows = 0;
  std::vector<double> values;

  explicit FieldMap(const world::Rectangle& inside) : origin(inside.min) {
    const Vector2d size = (inside.max - inside.min) / kMapCellM;
    columns = static_cast<int>(std::ceil(size.x()));
    rows = static_cast<int>(std::ceil(size.y()));
    values.assign(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), 0);
  }
  Vector2d centre(std::size_t index) const {
    const std::size_t column = index % static_cast<std::size_t>(columns);
    const std::size_t row = index / static_cast<std::size_t>(columns);
    return origin +
           kMapCellM * Vector2d(static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5);
  }
};

void draw_place(const world::Scenario& scenario, Plot& plot) {
  for (const world::Building& building : scenario.buildings) {
    plot.area(building.footprint, kWallColour, 0.8);
  }
  for (const world::Exit& exit : scenario.exits) {
    const std::array<Vector2d, 2> door = {exit.from, exit.to};
    plot.line(door, exit.open ? "#009E73" : "#000000", 4);
  }
}

Plot ground_plot(const std::string& title, const world::Scenario& scenario) {
  return {{title, "x (m)", "y (m)"},
          {scenario.inside.min.x(), scenario.inside.max.x()},
          {scenario.inside.min.y(), scenario.inside.max.y()},
          true};
}

std::string map_chart(const std::string& title, const std::string& unit, const FieldMap& map,
                      const world::Scenario& scenario) {
  Plot plot = ground_plot(title, scenario);
  const double most = *std::max_element(map.values.begin(), map.values.end());
  const Vector2d half = Vector2d::Constant(0.5 * kMapCellM);
  for (std::size_t i = 0; i < map.values.size(); ++i) {
    if (most <= 0 || map.values[i] < 0.01 * most) continue;
    plot.tile(map.centre(i) - half, map.centre(i) + half, heat(map.values[i] / most));
  }
  draw_place(scenario, plot);
  for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    plot.legend(fmt::format("{:.3g} {}", share * most, unit), heat(share));
  }
  return plot.svg();
}

std::vector<metrics::NearPerson> people_at(const world::Trace& trace, std::size_t step,
                                           const world::Rectangle& inside) {
  std::vector<metrics::NearPerson> people;
  for (std::size_t agent = 0; agent < trace.agents(); ++agent) {
    if (trace.header.role[agent] != world::AgentRole::person || !trace.present(step, agent)) {
      continue;
    }
    const std::size_t at = trace.at(step, agent);
    metrics::NearPerson person;
    person.agent = agent;
    person.place = trace.position[at].cast<double>();
    person.velocity = trace.velocity[at].cast<double>();
    if (inside.contains(person.place)) people.push_back(person);
  }
  return people;
}

// What the maps and the fundamental diagram show, from one sample a second.
struct GroundFigures {
  FieldMap density;
  FieldMap pressure;
  std::vector<Vector2d> density_and_speed;
};

GroundFigures ground_figures(const MeasuredRun& run, const world::Scenario& scenario) {
  GroundFigures figures{FieldMap(scenario.inside), FieldMap(scenario.inside), {}};
  const metrics::VoronoiCutter cutter(scenario.buildings);
  int samples = 0;
  for (std::size_t step = 0; step < run.trace.steps(); step += steps_per_second(run.trace)) {
    ++samples;
    const auto people = people_at(run.trace, step, scenario.inside);
    if (people.empty()) continue;
    std::vector<Vector2d> places;
    places.reserve(people.size());
    for (const auto& person : people) places.push_back(person.place);
    const metrics::PointGrid grid(places, metrics::kPressureRadiusM);
    for (std::size_t i = 0; i < places.size(); ++i) {
      const Vector2d cell = (places[i] - figures.density.origin) / kMapCellM;
      const int column = std::min(static_cast<int>(cell.x()), figures.density.columns - 1);
      const int row = std::min(static_cast<int>(cell.y()), figures.density.rows - 1);
      figures.density.values[static_cast<std::size_t>(row) *
                                 static_cast<std::size_t>(figures.density.columns) +
                             static_cast<std::size_t>(column)] += 1;
      figures.density_and_speed.emplace_back(cutter.cell(grid, i).density_per_m2(),
                                             people[i].velocity.norm());
    }
    for (std::size_t i = 0; i < figures.pressure.values.size(); ++i) {
      double& most = figures.pressure.values[i];
      most = std::max(most, metrics::pressure_at(figures.pressure.centre(i), grid, people));
    }
  }
  for (double& value : figures.density.values) {
    value /= std::max(1, samples) * kMapCellM * kMapCellM;
  }
  return figures;
}

std::string fundamental_chart(const std::vector<Vector2d>& density_and_speed) {
  double fastest = 1.5;
  for (const Vector2d& sample : density_and_speed) fastest = std::max(fastest, sample.y());
  Plot plot({"Fundamental diagram", "Voronoi density of each person (1/m²)", "speed (m/s)"}, {0, 6},
            {0, std::ceil(2 * fastest) / 2});
  const std::size_t stride = density_and_speed.size() / kMostDots + 1;
  for (std::size_t i = 0; i < density_and_speed.size(); i += stride) {
    if (density_and_speed[i].x() <= 6) plot.dot(density_and_speed[i], kRunColour);
  }
  // Weidmann 1993: v = 1.34 (1 - exp(-1.913 (1/density - 1/5.4))).
  std::vector<Vector2d> curve;
  for (double density = 0.05; density <= 5.4; density += 0.05) {
    curve.emplace_back(density, 1.34 * (1 - std::exp(-1.913 * (1 / density - 1 / 5.4))));
  }
  plot.line(curve, "#D55E00", 2);
  plot.legend("people, each 1 s", kRunColour);
  plot.legend("Weidmann 1993", "#D55E00");
  return plot.svg();
}

std::string ways_chart(const MeasuredRun& run, const world::Scenario& scenario) {
  Plot plot = ground_plot("Ways of the people, " + run.name, scenario);
  const world::Trace& trace = run.trace;
  const std::size_t stride = steps_per_second(trace);
  for (std::size_t agent = 0; agent < trace.agents(); ++agent) {
    if (trace.header.role[agent] != world::AgentRole::person) continue;
    std::vector<Vector2d> way;
    for (std::size_t step = 0; step < trace.steps(); step += stride) {
      if (!trace.present(step, agent)) continue;
      const Vector2d place = trace.position[trace.at(step, agent)].cast<double>();
      if (!scenario.inside.contains(place)) break;
      way.push_back(place);
    }
    if (way.size() > 1) plot.line(way, kRunColour, 0.6, 0.35);
  }
  draw_place(scenario, plot);
  plot.legend("ways", kRunColour);
  plot.legend("buildings", kWallColour);
  plot.legend("open exits", "#009E73");
  plot.legend("closed exits", "#000000");
  return plot.svg();
}

std::string time_cell(const std::optional<double>& seconds) {
  return seconds && std::isfinite(*seconds) ? fmt::format("{:.1f}", *seconds) : "not reached";
}

std::string runs_table(const std::vector<MeasuredRun>& runs) {
  std::string html =
      "<table><tr><th>run</th><th>people</th><th>not escaped</th><th>mean escape (s)</th>";
  for (const auto& percentile : runs.front().metrics.percentiles) {
    html += fmt::format("<th>T{} (s)</th>", percentile.percent);
  }
  html += "<th>balance</th><th>crush proxy (person s)</th></tr>\n";
  for (const MeasuredRun& run : runs) {
    html += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td>{:.1f}</td>",
                        escaped_markup(run.name), run.metrics.people, run.metrics.not_escaped,
                        run.metrics.mean_escape_time_s);
    for (const auto& percentile : run.metrics.percentiles) {
      html += fmt::format("<td>{}</td>", time_cell(percentile.time_s));
    }
    html += run.metrics.balance ? fmt::format("<td>{:.2f}</td>", run.metrics.balance->balance)
                                : "<td></td>";
    html += fmt::format("<td>{:.0f}</td></tr>\n", run.metrics.exposure.crush_proxy_person_s);
  }
  return html + "</table>\n";
}

std::string exits_table(const MeasuredRun& run) {
  std::string html =
      "<table><tr><th>exit</th><th>width (m)</th><th>crossings</th><th>flow with demand (1/s)</th>"
      "<th>specific (1/(m s))</th><th>demand (s)</th><th>congested (s)</th><th>clogged (s)</th>"
      "<th>clogs</th><th>clogging index</th><th>longest queue</th><th>longest gap (s)</th>"
      "<th>max density (1/m²)</th><th>max pressure (1/s²)</th></tr>\n";
  for (const metrics::ExitTotals& exit : run.metrics.exits) {
    const double flow = exit.demand_flow_per_s.value_or(0);
    html += fmt::format(
        "<tr><td>{}</td><td>{:.2f}</td><td>{}</td><td>{:.2f}</td><td>{:.2f}</td><td>{:.1f}</td>"
        "<td>{:.1f}</td><td>{:.1f}</td><td>{}</td><td>{:.2f}</td><td>{}</td><td>{}</td>"
        "<td>{:.2f}</td><td>{:.3f}</td></tr>\n",
        escaped_markup(exit.exit_id), exit.width_m, exit.crossings, flow, flow / exit.width_m,
        exit.demand_s, exit.congested_s, exit.clogged_s, exit.clogs.size(),
        exit.mean_clogging_index, exit.max_queue,
        exit.gaps.longest_s ? fmt::format("{:.1f}", *exit.gaps.longest_s) : "",
        exit.max_voronoi_density_per_m2, exit.max_pressure_per_s2);
  }
  return html + "</table>\n";
}

constexpr const char* kStyle =
    "body{font-family:sans-serif;max-width:72em;margin:2em auto;padding:0 1em;color:#222}"
    "table{display:block;overflow-x:auto;border-collapse:collapse;margin:1em 0;font-size:13px}"
    "td,th{border:1px solid #ccc;padding:3px 7px;text-align:right}"
    "th{background:#f3f3f3}td:first-child{text-align:left}svg{display:block;margin:1em 0;"
    "max-width:100%;height:auto}label{margin-right:1em}";

/// Style by which only the run that is chosen is shown: a selector that needs no script.
std::string shown_when_chosen(std::size_t runs) {
  if (runs < 2) return "";
  std::string style = "section{display:none}";
  for (std::size_t i = 0; i < runs; ++i) {
    style += fmt::format("#run{0}:checked~#of_run{0}{{display:block}}", i);
  }
  return style + "@media print{section{display:block}}";
}

/// Exits, maps, diagram and ways of one run.
std::string run_charts(const MeasuredRun& run, const world::Scenario& scenario) {
  const GroundFigures ground = ground_figures(run, scenario);
  return "<h3>Exits, " + escaped_markup(run.name) + "</h3>\n" + exits_table(run) +
         timeline_chart(run) + "<h3>Ground, " + escaped_markup(run.name) + "</h3>\n" +
         map_chart("Mean density over the run", "/m²", ground.density, scenario) +
         map_chart("Greatest crowd pressure (sampled each second)", "/s²", ground.pressure,
                   scenario) +
         fundamental_chart(ground.density_and_speed) + ways_chart(run, scenario);
}

}  // namespace

MeasuredRun measured(std::string name, world::Trace trace, const world::Scenario& scenario) {
  MeasuredRun run{std::move(name), std::move(trace), {}, {}};
  run.exits = metrics::exit_series(run.trace, scenario);
  run.metrics = metrics::run_metrics(run.trace, scenario, run.exits);
  return run;
}

std::string html_report(const world::Scenario& scenario, const std::vector<MeasuredRun>& runs) {
  check(!runs.empty(), "a report has a run");
  const std::string title = escaped_markup(scenario.name.empty() ? scenario.id : scenario.name);
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{0}</title>"
      "<style>{1}{2}</style></head><body>\n<h1>{0}</h1>\n<p>{3}</p>\n<p>{4} run{5}, {6}, "
      "definitions version {7} (docs/metrics.md). A time that was not reached before the run ended "
      "is called so; the mean escape time counts the run's end for who was still inside.</p>\n"
      "<h2>{8}</h2>\n{9}{10}",
      title, kStyle, shown_when_chosen(runs.size()), escaped_markup(scenario.description),
      runs.size(), runs.size() == 1 ? "" : "s", kGenerator, metrics::kDefinitionsVersion,
      runs.size() == 1 ? "Run" : "All runs", runs_table(runs), escape_chart(runs));
  if (runs.size() > 1) html += "<h2>One run</h2>\n";
  for (std::size_t i = 0; i < runs.size() && runs.size() > 1; ++i) {
    html += fmt::format(
        "<input type=\"radio\" name=\"run\" id=\"run{0}\"{1}><label for=\"run{0}\">{2}</label>\n",
        i, i == 0 ? " checked" : "", escaped_markup(runs[i].name));
  }
  for (std::size_t i = 0; i < runs.size(); ++i) {
    html +=
        fmt::format("<section id=\"of_run{}\">\n{}</section>\n", i, run_charts(runs[i], scenario));
  }
  return html + "</body></html>\n";
}

}  // namespace throng::study
