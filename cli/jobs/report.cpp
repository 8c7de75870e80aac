// throng report: traces of one place as one HTML file, or the report of a job on a server.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <thread>

#include "base/error.h"
#include "base/files/files.h"
#include "base/text/url.h"
#include "cli/jobs/job_report.h"
#include "cli/remote/api_client.h"
#include "cli/remote/bundle.h"
#include "cli/shell/commands.h"
#include "cli/shell/file_kind.h"
#include "cli/shell/input_file.h"
#include "cli/shell/interrupt.h"
#include "cli/shell/scenario_named.h"
#include "cli/shell/trace_file.h"
#include "jobs/queue/dataset/run_warnings.h"
#include "jobs/queue/store/job_id.h"
#include "jobs/study/run_report.h"
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

bool is_on_server(const ReportArguments& arguments) {
  return arguments.inputs.size() == 1 && !fs::exists(arguments.inputs[0]) &&
         jobs::is_job_id(arguments.inputs[0]);
}

void fetch_report(const std::string& id, const fs::path& output) {
  const Interrupt interrupt;
  ApiClient api;
  write_file_atomically(output,
                        api.wait_for_text("/v1/jobs/" + percent_encoded(id) + "/report",
                                          [&] { return !interrupt.token().stop_requested(); }));
}

std::string report_of_traces(const ReportArguments& arguments) {
  std::vector<NamedTrace> traces;
  for (const std::string& input : arguments.inputs) find_traces(input, traces);
  std::optional<world::Scenario> scenario;
  std::string id;
  std::vector<study::MeasuredRun> runs;
  for (const NamedTrace& named : traces) {
    world::Trace trace = read_trace_file(named.file);
    if (!scenario) {
      scenario = scenario_of_trace(arguments.scenario, trace.header, named.file.string());
      id = trace.header.scenario_id;
    }
    if (arguments.scenario.empty() && trace.header.scenario_id != id) {
      throw InputError({named.file.string(), "", trace.header.scenario_id,
                        fmt::format("a run of {}, as the first one", id)});
    }
    runs.push_back(
        study::measured(named.name, std::move(trace), *scenario, jobs::task_warnings(named.file)));
  }
  return study::html_report(*scenario, runs);
}

void report(const ReportArguments& arguments) {
  check_output_file("--output", arguments.output, arguments.inputs);
  check_ending("--output", arguments.output, {".html", ".htm"});
  if (is_on_server(arguments)) {
    fetch_report(arguments.inputs[0], arguments.output);
  } else {
    write_file_atomically(arguments.output, report_of_traces(arguments));
  }
  fmt::print("{}\n", arguments.output);
}

}  // namespace

std::string report_of_job(const fs::path& folder) {
  return report_of_traces({{folder.string()}, "", ""});
}

void add_report(CLI::App& app) {
  auto* command = app.add_subcommand(
      "report", "Charts and tables of one or several runs as one self-contained HTML file");
  const auto arguments = std::make_shared<ReportArguments>();
  command
      ->add_option(
          "inputs", arguments->inputs,
          "Traces, folders of traces, or folders of jobs; all of one scenario. Or the id of "
          "one job on the server ($THRONG_URL)")
      ->required();
  command->add_option(
      "--scenario", arguments->scenario,
      "Id or file (.json) of the scenario; default: the one that the first trace holds");
  command->add_option("-o,--output", arguments->output, "HTML file to write")->required();
  command->callback([arguments] { report(*arguments); });
}

}  // namespace throng::cli
