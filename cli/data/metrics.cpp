// throng metrics: the figures of a run, or of recorded people, at the exits of a scenario.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <limits>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "annotate/exits_csv.h"
#include "base/error.h"
#include "base/files/files.h"
#include "cli/shell/commands.h"
#include "cli/shell/file_kind.h"
#include "cli/shell/input_file.h"
#include "cli/shell/scenario_named.h"
#include "cli/shell/trace_file.h"
#include "jobs/queue/dataset/run_warnings.h"
#include "metrics/evacuation.h"
#include "metrics/exits/exits.h"
#include "metrics/trajectories/recorded_findings.h"
#include "metrics/trajectories/trajectory_file.h"
#include "world/scenario.h"
#include "world/trace.h"

namespace throng::cli {

namespace {

struct MetricsArguments {
  std::string trace;
  std::string trajectory;
  std::string scenario;
  std::string output;
  std::string csv;
  std::string to_file;
  std::string without_guides;
  metrics::WalkerDefaults walkers;
  metrics::TrajectoryFormat format;
};

void write_csv(const std::vector<metrics::ExitSeries>& exits, const world::Trace& trace,
               const std::string& file) {
  std::vector<annotate::FrameTime> steps;
  for (std::size_t step = 0; step < trace.steps(); ++step) {
    steps.push_back({static_cast<std::int64_t>(step), trace.time_s[step]});
  }
  write_file_atomically(file, annotate::exits_csv(exits, trace.time_s, steps));
}

// Recorded people who are never inside the scenario are usually in other units or axes.
void check_somebody_inside(const world::Trace& trace, const world::Scenario& scenario,
                           const std::string& file) {
  Eigen::Vector2f min = Eigen::Vector2f::Constant(std::numeric_limits<float>::max());
  Eigen::Vector2f max = -min;
  for (std::size_t i = 0; i < trace.position.size(); ++i) {
    if ((trace.flags[i] & world::kPresent) == 0) continue;
    if (scenario.inside.contains(trace.position[i].cast<double>())) return;
    min = min.cwiseMin(trace.position[i]);
    max = max.cwiseMax(trace.position[i]);
  }
  const world::Rectangle& place = scenario.inside.bounds;
  throw InputError(
      {file, "",
       fmt::format(
           "nobody inside the scenario at any time, but people from ({:.4g}, {:.4g}) to ({:.4g}, "
           "{:.4g}) m",
           min.x(), min.y(), max.x(), max.y()),
       fmt::format("people in ({:.4g}, {:.4g}) to ({:.4g}, {:.4g}) m of {}; --unit-m 0.01 is for "
                   "centimeters",
                   place.min.x(), place.min.y(), place.max.x(), place.max.y(), scenario.id)});
}

/// With the walkable area of the scenario that is given or that the trace holds, if any.
void write_converted(const MetricsArguments& arguments, const world::Trace& trace) {
  std::optional<world::Scenario> scenario;
  if (!arguments.scenario.empty()) {
    scenario = scenario_named(arguments.scenario);
  } else if (!trace.header.scenario_document.empty()) {
    scenario =
        world::scenario_in_trace(trace.header, arguments.trace, world::TraceMeshes::left_out);
  }
  metrics::write_trajectory(trace, arguments.to_file, scenario ? &*scenario : nullptr);
}

void measure(const MetricsArguments& arguments) {
  const bool recorded = !arguments.trajectory.empty();
  if (recorded == !arguments.trace.empty()) {
    if (!recorded) {
      throw InputError(
          {"throng metrics", "", "missing TRACE or --trajectory (`throng metrics --help`)", ""});
    }
    throw InputError({"throng metrics", "", "a trace and a trajectory", "one of them"});
  }
  for (const auto& [option, output] :
       {std::pair{"--output", &arguments.output}, std::pair{"--csv", &arguments.csv},
        std::pair{"--to", &arguments.to_file}}) {
    check_output_file(
        option, *output,
        {arguments.trace, arguments.trajectory, arguments.without_guides, arguments.scenario});
  }
  check_ending("--csv", arguments.csv, {".csv"});
  if (recorded) refuse_as_trajectory(arguments.trajectory);
  std::vector<Problem> notes;
  const world::Trace trace = recorded
                                 ? metrics::read_trajectory(arguments.trajectory, arguments.walkers,
                                                            arguments.format, &notes)
                                 : read_trace_file(arguments.trace);
  if (!arguments.to_file.empty()) {
    write_converted(arguments, trace);
    fmt::print("{}\n", arguments.to_file);
    if (arguments.output.empty() && arguments.csv.empty()) {
      for (const Problem& note : notes) fmt::print(stderr, "warning: {}\n", note.text());
      return;
    }
  }
  if (recorded && arguments.scenario.empty()) {
    throw InputError(
        {"--scenario", "", "nothing", "the scenario whose exits the recorded people walk to"});
  }
  const world::Scenario scenario =
      scenario_of_trace(arguments.scenario, trace.header, arguments.trace);
  if (recorded) check_somebody_inside(trace, scenario, arguments.trajectory);
  const std::vector<metrics::ExitSeries> exits = metrics::exit_series(trace, scenario);
  const metrics::RunMetrics measured = metrics::run_metrics(trace, scenario, exits);
  nlohmann::json figures = metrics::to_json(measured);
  std::vector<std::string> warnings;
  if (recorded) {
    for (Problem& finding : metrics::find_people_in_buildings(trace, scenario)) {
      notes.push_back(std::move(finding));
    }
    for (const Problem& note : notes) warnings.push_back(note.text());
  } else {
    warnings = jobs::task_warnings(arguments.trace);
  }
  for (std::string& warning : metrics::count_warnings(measured.counts)) {
    warnings.push_back(std::move(warning));
  }
  for (const std::string& warning : warnings) fmt::print(stderr, "warning: {}\n", warning);
  figures["warnings"] = std::move(warnings);
  if (!arguments.without_guides.empty()) {
    metrics::add_to_json(
        metrics::lead_effect(trace, read_trace_file(arguments.without_guides), scenario),
        figures["guidance"]);
  }
  const std::string text = figures.dump(2) + "\n";
  if (arguments.output.empty()) {
    fmt::print("{}", text);
  } else {
    write_file_atomically(arguments.output, text);
    fmt::print("{}\n", arguments.output);
  }
  if (!arguments.csv.empty()) write_csv(exits, trace, arguments.csv);
}

// Metadata that a trajectory file lacks, as in a job's block crowd.recorded.
void add_format(CLI::App& command, const std::shared_ptr<MetricsArguments>& arguments) {
  metrics::TrajectoryFormat& format = arguments->format;
  static const std::map<std::string, metrics::TrajectoryKind> kKinds = {
      {"any", metrics::TrajectoryKind::any},       {"text", metrics::TrajectoryKind::text},
      {"sqlite", metrics::TrajectoryKind::sqlite}, {"scb", metrics::TrajectoryKind::scb},
      {"csv", metrics::TrajectoryKind::csv},       {"hdf5", metrics::TrajectoryKind::hdf5},
      {"fcd", metrics::TrajectoryKind::fcd},       {"json", metrics::TrajectoryKind::json_text}};
  command
      .add_option("--format", format.kind,
                  "Format of the trajectory; default: by suffix and content")
      ->transform(
          CLI::CheckedTransformer(kKinds).description("{any,text,sqlite,scb,csv,hdf5,fcd,json}"))
      ->type_name("TEXT");
  command.add_option("--frame-rate", format.frames_per_s, "Frame rate of the trajectory, 1/s")
      ->check(CLI::Range(0.01, 10'000.0));
  command.add_option("--unit-m", format.unit_m, "Length of the trajectory's unit, m (cm: 0.01)")
      ->check(CLI::Range(1e-6, 1e6));
  command.add_option("--person-column", format.columns.person, "Column of a CSV")
      ->capture_default_str();
  auto* frame = command.add_option("--frame-column", format.columns.frame, "Column of a CSV")
                    ->capture_default_str();
  command.add_option("--time-column", format.columns.time, "Column of a CSV, s, instead of frames")
      ->excludes(frame);
  command.add_option("--x-column", format.columns.x, "Column of a CSV")->capture_default_str();
  command.add_option("--y-column", format.columns.y, "Column of a CSV")->capture_default_str();
  command.add_option_function<std::string>(
      "--columns",
      [&format](const std::string& words) { format.columns = metrics::columns_in_order(words); },
      "The columns in their order, such as frame,id,x,y: id, frame or time, x, y, and - for "
      "others");
}

}  // namespace

void add_metrics(CLI::App& app) {
  auto* command = app.add_subcommand(
      "metrics", "Measure a trace or recorded trajectories: exits, clogs, evacuation, exposure");
  const auto arguments = std::make_shared<MetricsArguments>();
  command->add_option("trace", arguments->trace, "Trace of a run (HDF5)");
  command->add_option("--trajectory", arguments->trajectory,
                      "Recorded trajectories instead: text, tables, JuPedSim's SQLite, the Data "
                      "Archive's HDF5, SUMO's FCD, "
                      "Menge's .scb and others (docs/recorded.md)");
  command->add_option("--scenario", arguments->scenario,
                      "Id or file (.json) of the scenario; default: the one that the trace holds");
  command->add_option("-o,--output", arguments->output, "JSON to write; default: standard output");
  command->add_option("--csv", arguments->csv, "Also write the exits' time series (CSV)");
  command->add_option("--to,--to-jupedsim", arguments->to_file,
                      "Convert to a trajectory file of JuPedSim (.txt, .sqlite) or Menge (.scb)");
  command->add_option("--without-guides", arguments->without_guides,
                      "Trace of the same run without drones, for the guides' effect");
  command->add_option("--radius", arguments->walkers.radius_m, "Body radius of recorded people, m")
      ->check(CLI::Range(0.05, 2.0))
      ->capture_default_str();
  command
      ->add_option("--desired-speed", arguments->walkers.desired_speed_mps,
                   "Desired speed of recorded people, m/s")
      ->check(CLI::Range(0.1, 20.0))
      ->capture_default_str();
  add_format(*command, arguments);
  command->callback([arguments] { measure(*arguments); });
}

}  // namespace throng::cli
