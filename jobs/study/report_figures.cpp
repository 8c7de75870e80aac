#include "jobs/study/report_figures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/geometry/point_grid.h"
#include "jobs/study/page.h"
#include "jobs/study/statistics.h"
#include "metrics/density/pressure.h"
#include "metrics/density/voronoi.h"

namespace throng::study {

using Eigen::Vector2d;
using nlohmann::json;

namespace {

constexpr double kMapCellM = 1.0;
constexpr std::size_t kMaxDots = 4000;
constexpr double kDensestShown = 6;  // 1/m^2
constexpr double kBinWidth = 0.25;   // 1/m^2
constexpr std::size_t kMinInBin = 20;

std::size_t steps_per_second(const world::Trace& trace) {
  return static_cast<std::size_t>(std::max<long>(1, std::lround(1 / trace.header.dt_s)));
}

json point(const Vector2d& place) { return {rounded(place.x(), 2), rounded(place.y(), 2)}; }

json escape_figures(const std::vector<MeasuredRun>& runs) {
  std::size_t seconds = 0;
  json curves = json::array();
  std::vector<std::vector<double>> of_runs;
  for (const MeasuredRun& run : runs) {
    const std::vector<double>& curve = of_runs.emplace_back(run.metrics.escapes.curve());
    seconds = std::max(seconds, curve.size());
    json share = json::array();
    for (const double value : curve) share.push_back(rounded(100 * value));
    curves.push_back({{"name", run.name}, {"share", std::move(share)}});
  }
  json middle = json::array();
  json low = json::array();
  json high = json::array();
  for (std::size_t second = 0; second < seconds; ++second) {
    std::vector<double> shares;
    shares.reserve(of_runs.size());
    for (const std::vector<double>& curve : of_runs) {
      shares.push_back(100 * curve[std::min(second, curve.size() - 1)]);
    }
    middle.push_back(rounded(median(shares)));
    low.push_back(rounded(quantile(shares, 0.25)));
    high.push_back(rounded(quantile(shares, 0.75)));
  }
  return {{"runs", std::move(curves)},
          {"median", std::move(middle)},
          {"low", std::move(low)},
          {"high", std::move(high)}};
}

json scenario_figures(const world::Scenario& scenario) {
  json buildings = json::array();
  for (const world::Building& building : scenario.buildings) {
    json corners = json::array();
    for (const Vector2d& corner : building.footprint) corners.push_back(point(corner));
    buildings.push_back(std::move(corners));
  }
  json exits = json::array();
  for (const world::Exit& exit : scenario.exits) {
    exits.push_back(
        {{"id", exit.id}, {"from", point(exit.from)}, {"to", point(exit.to)}, {"open", exit.open}});
  }
  return {{"min", point(scenario.inside.bounds.min)},
          {"max", point(scenario.inside.bounds.max)},
          {"buildings", std::move(buildings)},
          {"exits", std::move(exits)}};
}

json state_figures(const MeasuredRun& run) {
  json exits = json::array();
  for (const metrics::ExitSeries& exit : run.exits) {
    json spans = json::array();
    for (std::size_t from = 0; from < exit.samples.size();) {
      std::size_t to = from;
      while (to < exit.samples.size() && exit.samples[to].state == exit.samples[from].state) ++to;
      const double end_s = run.trace.time_s[std::min(to, exit.samples.size() - 1)];
      spans.push_back({rounded(run.trace.time_s[from]), rounded(end_s),
                       static_cast<int>(exit.samples[from].state)});
      from = to;
    }
    exits.push_back({{"id", exit.exit_id}, {"states", std::move(spans)}});
  }
  return exits;
}

// Values on a grid of meters over Scenario::inside.
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
  Vector2d center(std::size_t index) const {
    const std::size_t column = index % static_cast<std::size_t>(columns);
    const std::size_t row = index / static_cast<std::size_t>(columns);
    return origin +
           kMapCellM * Vector2d(static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5);
  }
  double& at(const Vector2d& place) {
    const Vector2d cell = (place - origin) / kMapCellM;
    const int column = std::clamp(static_cast<int>(cell.x()), 0, columns - 1);
    const int row = std::clamp(static_cast<int>(cell.y()), 0, rows - 1);
    return values[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                  static_cast<std::size_t>(column)];
  }
  json figures(const char* unit) const {
    json list = json::array();
    for (const double value : values) list.push_back(rounded(value, 4));
    return {
        {"cell_m", kMapCellM}, {"columns", columns}, {"unit", unit}, {"values", std::move(list)}};
  }
};

std::vector<metrics::NearPerson> people_at(const world::Trace& trace, std::size_t step,
                                           const geometry::Region& inside) {
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

// Data of the maps and the fundamental diagram, from one sample per second.
struct GroundFigures {
  FieldMap density;
  FieldMap pressure;
  std::vector<Vector2d> density_and_speed;
};

GroundFigures ground_figures(const MeasuredRun& run, const world::Scenario& scenario) {
  GroundFigures figures{FieldMap(scenario.inside.bounds), FieldMap(scenario.inside.bounds), {}};
  const metrics::VoronoiCutter cutter(scenario.buildings);
  int samples = 0;
  for (std::size_t step = 0; step < run.trace.steps(); step += steps_per_second(run.trace)) {
    ++samples;
    const auto people = people_at(run.trace, step, scenario.inside);
    if (people.empty()) continue;
    std::vector<Vector2d> places;
    places.reserve(people.size());
    for (const auto& person : people) places.push_back(person.place);
    const geometry::PointGrid grid(places, metrics::kPressureRadiusM);
    for (std::size_t i = 0; i < places.size(); ++i) {
      figures.density.at(places[i]) += 1;
      figures.density_and_speed.emplace_back(cutter.cell(grid, i).density_per_m2(),
                                             people[i].velocity.norm());
    }
    for (std::size_t i = 0; i < figures.pressure.values.size(); ++i) {
      double& pressure = figures.pressure.values[i];
      pressure = std::max(pressure, metrics::pressure_at(figures.pressure.center(i), grid, people));
    }
  }
  for (double& value : figures.density.values) {
    value /= std::max(1, samples) * kMapCellM * kMapCellM;
  }
  return figures;
}

json fundamental_figures(const std::vector<Vector2d>& density_and_speed) {
  json samples = json::array();
  const std::size_t stride = density_and_speed.size() / kMaxDots + 1;
  for (std::size_t i = 0; i < density_and_speed.size(); i += stride) {
    if (density_and_speed[i].x() <= kDensestShown) samples.push_back(point(density_and_speed[i]));
  }
  std::array<std::vector<double>, static_cast<std::size_t>(kDensestShown / kBinWidth)> speeds;
  for (const Vector2d& sample : density_and_speed) {
    const auto bin = static_cast<std::size_t>(sample.x() / kBinWidth);
    if (bin < speeds.size()) speeds[bin].push_back(sample.y());
  }
  json bins = json::array();
  for (std::size_t bin = 0; bin < speeds.size(); ++bin) {
    const std::vector<double>& values = speeds[bin];
    if (values.size() < kMinInBin) continue;
    bins.push_back({(static_cast<double>(bin) + 0.5) * kBinWidth, rounded(median(values)),
                    values.size(), rounded(quantile(values, 0.25)),
                    rounded(quantile(values, 0.75))});
  }
  return {{"samples", std::move(samples)}, {"bins", std::move(bins)}};
}

json path_figures(const MeasuredRun& run, const world::Scenario& scenario) {
  const world::Trace& trace = run.trace;
  const std::size_t stride = steps_per_second(trace);
  json paths = json::array();
  for (std::size_t agent = 0; agent < trace.agents(); ++agent) {
    if (trace.header.role[agent] != world::AgentRole::person) continue;
    json points = json::array();
    for (std::size_t step = 0; step < trace.steps(); step += stride) {
      if (!trace.present(step, agent)) continue;
      const Vector2d place = trace.position[trace.at(step, agent)].cast<double>();
      if (!scenario.inside.contains(place)) break;
      points.push_back(point(place));
    }
    if (points.size() > 1) paths.push_back({{"agent", agent}, {"points", std::move(points)}});
  }
  return paths;
}

}  // namespace

json report_figures(const world::Scenario& scenario, const std::vector<MeasuredRun>& runs) {
  json list = json::array();
  for (const MeasuredRun& run : runs) {
    const GroundFigures ground = ground_figures(run, scenario);
    list.push_back({{"name", run.name},
                    {"duration_s", rounded(run.trace.duration_s())},
                    {"exits", state_figures(run)},
                    {"density", ground.density.figures("/m²")},
                    {"pressure", ground.pressure.figures("/s²")},
                    {"fundamental", fundamental_figures(ground.density_and_speed)},
                    {"paths", path_figures(run, scenario)}});
  }
  return {{"escape", escape_figures(runs)},
          {"place", scenario_figures(scenario)},
          {"runs", std::move(list)}};
}

}  // namespace throng::study
