// throng serve: the HTTP service.
#include "server/serve.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "cli/commands.h"
#include "world/scenario.h"

namespace throng::cli {

void add_serve(CLI::App& app) {
  auto* command =
      app.add_subcommand("serve", "Serve jobs over HTTP (SQLite, local workers, files)");
  const auto options = std::make_shared<server::ServeOptions>();
  options->data = "throng-data";
  command->add_option("--data", options->data, "Folder for everything the service keeps")
      ->capture_default_str();
  command->add_option("--host", options->host, "Address to listen on")->capture_default_str();
  command->add_option("--port", options->port, "Port to listen on (0: any that is free)")
      ->check(CLI::Range(0, 65535))
      ->capture_default_str();
  command->add_option("--port-file", options->port_file,
                      "File to write the port to once it serves");
  command->add_option("--workers", options->workers, "Processes at work at once (0: one per core)")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command
      ->add_option("--keep-days", options->keep_days,
                   "Remove jobs so many days after their end (0: never)")
      ->check(CLI::NonNegativeNumber);
  command
      ->add_option("--keep-gib", options->keep_gib,
                   "Remove the jobs that ended first while all take more disk (0: any)")
      ->check(CLI::NonNegativeNumber);
  command
      ->add_option("--uploads-gib", options->uploads_gib,
                   "What all uploaded scenarios may take together")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command
      ->add_option("--least-free", options->min_free_mib,
                   "MiB of free disk below which the queue rests")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command
      ->add_option("--task-timeout", options->max_task_s,
                   "Seconds after which a worker counts as hung (0: any time)")
      ->check(CLI::NonNegativeNumber);
  command
      ->add_option("--worker-memory", options->worker_memory_mib,
                   "MiB of address space that each worker may use (0: any)")
      ->check(CLI::NonNegativeNumber);
  command->add_flag("--log-json", options->log_json, "Log lines as JSON");
  command->add_flag(
      "--insecure", options->insecure,
      "Listen on addresses that other machines can reach while there are no keys: whoever "
      "reaches them may do everything");
  command->callback([options] {
    options->scenarios = world::scenarios_folder();
    server::serve(*options);
  });
}

}  // namespace throng::cli
