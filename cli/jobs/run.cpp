// throng run: a job here and now, without a server.
#include <CLI/CLI.hpp>
#include <memory>

#include "cli/jobs/job_runner.h"
#include "cli/shell/commands.h"
#include "skinning/population.h"
#include "skinning/population_files.h"

namespace throng::cli {

void add_run(CLI::App& app) {
  auto* command =
      app.add_subcommand("run", "Run a job without a server: simulate, render, annotate");
  const auto arguments = std::make_shared<JobArguments>();
  add_job_options(*command, *arguments);
  command->callback([arguments] {
    const jobs::ResolvedJob job = read_job_file(arguments->job_file);
    // Before anything is simulated or written: images need people.
    if (!job.spec().drones.empty()) skinning::read_index(skinning::population_folder());
    const jobs::ResolvedJob targeted = with_target(job, *arguments);
    finish_job(jobs::JobFolder::create(arguments->output, targeted), targeted, *arguments);
  });
}

}  // namespace throng::cli
