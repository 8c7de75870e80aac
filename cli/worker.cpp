// throng worker: one task of a job, for its supervisor.
#include <CLI/CLI.hpp>
#include <cstdlib>
#include <memory>

#include "cli/commands.h"
#include "jobs/pipeline/worker.h"

namespace throng::cli {

void add_worker(CLI::App& app) {
  struct Arguments {
    std::string job_folder;
    std::string task;
  };
  auto* command =
      app.add_subcommand("worker", "Run one task of a job folder (started by run and serve)");
  const auto arguments = std::make_shared<Arguments>();
  command->add_option("--job", arguments->job_folder, "The job's folder")->required();
  command->add_option("--task", arguments->task, "The task's name, e.g. run000/shard0003")
      ->required();
  // The worker's exit codes: its supervisor retries only where that makes sense.
  command->callback(
      [arguments] { std::exit(jobs::run_worker(arguments->job_folder, arguments->task)); });
}

}  // namespace throng::cli
