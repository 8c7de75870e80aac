// throng report: traces of one place as one HTML file.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>

#include "base/error.h"
#include "base/files.h"
#include "cli/commands.h"
#include "cli/scenario_named.h"
#include "study/run_report.h"
#include "world/trace.h"

namespace throng::cli {

namespace fs = std::filesystem;

namespace {

struct ReportArguments {
  std::vector<std::string> inputs;
  std::string scenario;
  std::string output;
};

struct NamedTrace {
  std::string name;
  fs::path file;
};

// A trace, a folder of traces (*.h5), or a job's folder (work/runNNN/trace.h5).
void find_traces(const fs::path& input, std::vector<NamedTrace>& traces) {
  if (!fs::is_directory(input)) {
    traces.push_back({input.stem().string(), input});
    return;
  }
  std::vector<NamedTrace> found;
  const bool job = fs::is_directory(input / "work");
  for (const auto& entry : fs::directory_iterator(job ? input / "work" : input)) {
    const fs::path trace = job ? entry.path() / "trace.h5" : entry.path();
    if (trace.extension() != ".h5" || !fs::is_regular_file(trace)) continue;
    found.push_back({entry.path().stem().string(), trace});
  }
  if (found.empty()) {
    throw InputError({input.string(), "", "no traces", "files *.h5, or the folder of a job"});
  }
  std::sort(found.begin(), found.end(),
            [](const NamedTrace& a, const NamedTrace& b) { return a.file < b.file; });
  traces.insert(traces.end(), found.begin(), found.end());
}

void report(const ReportArguments& arguments) {
  std::vector<NamedTrace> traces;
  for (const std::string& input : arguments.inputs) find_traces(input, traces);
  std::vector<study::MeasuredRun> runs;
  std::string place = arguments.scenario;
  for (const NamedTrace& named : traces) {
    world::Trace trace = world::read_trace(named.file);
    if (place.empty()) place = trace.header.scenario_id;
    if (arguments.scenario.empty() && trace.header.scenario_id != place) {
      throw InputError({named.file.string(), "", trace.header.scenario_id,
                        fmt::format("a run of {}, as the first one", place)});
    }
    runs.push_back(study::measured(named.name, std::move(trace), scenario_named(place)));
  }
  write_file_atomically(arguments.output, study::html_report(scenario_named(place), runs));
  fmt::print("{}\n", arguments.output);
}

}  // namespace

void add_report(CLI::App& app) {
  auto* command = app.add_subcommand(
      "report", "Charts and tables of one or several runs as one self-contained HTML file");
  const auto arguments = std::make_shared<ReportArguments>();
  command
      ->add_option("inputs", arguments->inputs,
                   "Traces, folders of traces, or folders of jobs; all of one scenario")
      ->required();
  command->add_option("--scenario", arguments->scenario,
                      "Id or file (.json) of the scenario; default: the first trace's");
  command->add_option("-o,--output", arguments->output, "HTML file to write")->required();
  command->callback([arguments] { report(*arguments); });
}

}  // namespace throng::cli
