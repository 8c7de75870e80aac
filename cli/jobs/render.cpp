// throng render: frames and labels of a trace that is there already.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/files/files.h"
#include "cli/jobs/job_runner.h"
#include "cli/shell/commands.h"
#include "cli/shell/trace_file.h"
#include "jobs/pipeline/checks/resolve.h"
#include "jobs/queue/dataset/folder.h"
#include "jobs/queue/trace_seal.h"
#include "spec/job/scenario_mix.h"
#include "spec/job/spec.h"
#include "world/fields/trace_scenario.h"
#include "world/trace.h"

namespace throng::cli {

namespace {

struct RenderArguments : JobArguments {
  std::string trace_file;
};

/// The trace must show the job's scenario, long enough, with the job's drones.
void check_fits(const world::Trace& trace, const jobs::JobSpec& job,
                const RenderArguments& arguments) {
  std::vector<Problem> problems;
  if (job.drones.empty()) {
    problems.push_back({arguments.job_file, "/drones", "nothing", "a drone, whose camera renders"});
  }
  if (trace.header.scenario_id != job.scenario) {
    problems.push_back({arguments.trace_file, "scenario", trace.header.scenario_id, job.scenario});
  }
  if (trace.duration_s() < job.capture.to_s) {
    problems.push_back({arguments.job_file, "/capture/to_s", fmt::format("{} s", job.capture.to_s),
                        fmt::format("at most the trace's {} s", trace.duration_s())});
  }
  for (std::size_t i = 0; i < job.drones.size(); ++i) {
    const std::string& id = job.drones[i].mission.id;
    const bool same = i < trace.header.drone_ids.size() && trace.header.drone_ids[i] == id;
    if (!same) {
      problems.push_back({arguments.job_file, fmt::format("/drones/{}/id", i), id,
                          "the drone that the trace has there"});
    }
  }
  if (!problems.empty()) throw InputError(problems);
}

/// A job of several scenarios in that of the trace.
jobs::JobSpec job_of_trace(const jobs::JobSpec& job, const world::Trace& trace) {
  for (const int run : jobs::first_runs(job)) {
    jobs::JobSpec one = jobs::in_scenario_of_run(job, run);
    if (one.scenario == trace.header.scenario_id) return one;
  }
  return jobs::in_scenario_of_run(job, 0);  // check_fits() reports it
}

/// The job, in the scenario that the trace holds, so that a job's folder is enough; else in the
/// shipped one.
jobs::JobSpec job_for(const world::Trace& trace, const RenderArguments& arguments) {
  const auto kept =
      world::scenario_in_trace(trace.header, arguments.trace_file, world::TraceMeshes::needed);
  if (!kept) return job_of_trace(read_job_file(arguments.job_file).spec(), trace);
  const jobs::JobSpec job =
      jobs::check_and_read_job(load_job_document(arguments.job_file), arguments.job_file);
  return jobs::resolve(job_of_trace(job, trace), *kept, arguments.job_file).spec();
}

void render(const RenderArguments& arguments) {
  const world::Trace trace = read_trace_file(arguments.trace_file);
  jobs::JobSpec job = job_for(trace, arguments);
  job.runs = 1;
  std::erase_if(job.outputs.exports.splits.runs,
                [](const auto& named) { return named.first != jobs::run_name(0); });
  check_fits(trace, job, arguments);
  const jobs::ResolvedJob one_run = with_target(jobs::ResolvedJob(std::move(job)), arguments);
  const auto folder = jobs::JobFolder::create(arguments.output, one_run);
  const auto place = folder.output_of({jobs::Task::Kind::simulate, 0, 0});
  write_file_atomically(place, read_file(arguments.trace_file));
  jobs::seal_trace(place);
  finish_job(folder, one_run, arguments);
}

}  // namespace

void add_render(CLI::App& app) {
  auto* command = app.add_subcommand("render", "Render and annotate a trace with a job's cameras");
  const auto arguments = std::make_shared<RenderArguments>();
  add_job_options(*command, *arguments);
  command->add_option("--trace", arguments->trace_file, "Trace that `throng simulate` wrote")
      ->required();
  command->callback([arguments] { render(*arguments); });
}

}  // namespace throng::cli
