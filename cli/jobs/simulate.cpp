// throng simulate: one run of a job, as a trace.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <utility>

#include "base/error.h"
#include "cli/jobs/job_runner.h"
#include "cli/shell/commands.h"
#include "cli/shell/file_kind.h"
#include "cli/shell/input_file.h"
#include "cli/shell/interrupt.h"
#include "cli/shell/progress_bar.h"
#include "jobs/pipeline/checks/rehearsal.h"
#include "jobs/pipeline/runs/job_scenario.h"
#include "jobs/pipeline/runs/run_input.h"
#include "sim/run.h"
#include "spec/job/scenario_mix.h"
#include "world/scenario.h"

namespace throng::cli {

namespace {

struct SimulateArguments {
  std::string job_file;
  std::string trace_file;
  int run = 0;
  std::string pilot_logs;
};

void simulate(const SimulateArguments& arguments) {
  check_output_file("--output", arguments.trace_file, {arguments.job_file});
  check_ending("--output", arguments.trace_file, {".h5", ".hdf5"});
  const jobs::JobSpec job = read_job_file(arguments.job_file).spec();
  if (arguments.run < 0 || arguments.run >= job.runs) {
    throw InputError({"--run", "", fmt::format("{}", arguments.run),
                      fmt::format("a run of the job: 0 to {}", job.runs - 1)});
  }
  const world::Scenario scenario = jobs::load_job_scenario(
      jobs::in_scenario_of_run(job, arguments.run), world::scenarios_folder());
  std::vector<Problem> warnings;
  std::vector<Problem> notes;
  const sim::RunSpec spec = jobs::run_spec(job, arguments.run, &notes);
  {
    const Interrupt interrupt;
    ProgressBar bar("simulating");
    warnings = sim::simulate(
        scenario, spec, arguments.trace_file,
        [&](double done_s, double total_s) {
          bar.show(done_s / total_s, fmt::format("{:.0f} of {:.0f} s", done_s, total_s));
        },
        interrupt.token(), arguments.pilot_logs);
  }
  for (const Problem& warning :
       jobs::warnings_of_run(std::move(warnings), spec, std::move(notes), scenario)) {
    fmt::print(stderr, "throng: warning: {}\n", warning.text());
  }
  fmt::print("{}\n", arguments.trace_file);
}

}  // namespace

void add_simulate(CLI::App& app) {
  auto* command = app.add_subcommand("simulate", "Simulate one run of a job and write its trace");
  const auto arguments = std::make_shared<SimulateArguments>();
  command->add_option("job", arguments->job_file, "Job file (JSON)")->required();
  command->add_option("-o,--output", arguments->trace_file, "Trace to write (HDF5)")->required();
  command->add_option("--run", arguments->run, "Index of the job's run")->capture_default_str();
  command->add_option("--pilot-logs", arguments->pilot_logs,
                      "Folder for DRONE.csv: each drone's set-points, for the policy pilot_log");
  command->callback([arguments] { simulate(*arguments); });
}

}  // namespace throng::cli
