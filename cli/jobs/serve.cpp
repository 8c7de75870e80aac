// throng serve: the HTTP service.
#include "server/serve.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "cli/jobs/executor_options.h"
#include "cli/shell/commands.h"
#include "world/scenario.h"

namespace throng::cli {

namespace {

/// How many jobs and how much time, memory and disk the service uses.
void add_limit_options(CLI::App& command, server::ServeOptions& options) {
  command
      .add_option("--max-active-jobs", options.max_active_jobs,
                  "Jobs in progress at once; each key may always have one")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command
      .add_option("--keep-days", options.keep_days,
                  "Remove jobs this many days after their end (0: never)")
      ->check(CLI::NonNegativeNumber);
  command
      .add_option("--keep-gib", options.keep_gib,
                  "Disk limit in GiB: beyond it, remove the jobs that ended first (0: none)")
      ->check(CLI::NonNegativeNumber);
  command
      .add_option("--uploads-gib", options.uploads_gib,
                  "Max size of all uploaded scenarios together, in GiB")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command
      .add_option("--min-free", options.min_free_mib,
                  "MiB of free disk below which the queue is paused")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command
      .add_option("--live-timeout", options.live_timeout_s,
                  "Seconds after which a live flight ends that nobody looks at")
      ->capture_default_str()
      ->check(CLI::Range(1.0, 3600.0));
  command
      .add_option(
          "--task-timeout", options.max_task_s,
          "Seconds after which a worker counts as hung (0: no limit; default: six hours, with "
          "Slurm that of the partition)")
      ->check(CLI::NonNegativeNumber);
  command
      .add_option("--drain-timeout", options.drain_timeout_s,
                  "Seconds that running tasks may take when the service drains (SIGUSR2, throng "
                  "drain); tasks that are ended start again after the next start")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command
      .add_option("--worker-memory", options.worker_memory_mib,
                  "Max MiB of address space per worker (0: by what its task needs)")
      ->check(CLI::NonNegativeNumber);
  command
      .add_option("--memory", options.memory_mib,
                  "MiB of memory for all workers together (0: 7/8 of the machine's)")
      ->check(CLI::NonNegativeNumber);
}

}  // namespace

void add_serve(CLI::App& app) {
  auto* command =
      app.add_subcommand("serve", "Serve jobs over HTTP (SQLite, workers here or in Slurm, files)");
  const auto options = std::make_shared<server::ServeOptions>();
  const auto executor = std::make_shared<jobs::ExecutorOptions>();
  options->data = "throng-data";
  command->add_option("--data", options->data, "Data folder of the service")->capture_default_str();
  command->add_option("--database", options->database,
                      "Folder of jobs, keys and webhooks, on a local disk, where the data folder "
                      "is on a network file system (default: the data folder)");
  command->add_option("--host", options->host, "Address to listen on")->capture_default_str();
  command->add_option("--port", options->port, "Port to listen on (0: any that is free)")
      ->check(CLI::Range(0, 65535))
      ->capture_default_str();
  command->add_option("--port-file", options->port_file,
                      "File for the port number, written when the service is ready");
  command
      ->add_option("--workers", options->workers,
                   "Parallel worker processes (0: one per core; in Slurm any number)")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  add_executor_options(*command, *executor);
  add_limit_options(*command, *options);
  command
      ->add_option("--publish-to", options->publish_to,
                   "Address that jobs may publish their datasets to, and below it: "
                   "s3://BUCKET/PREFIX; repeatable (docs/publishing.md)")
      ->allow_extra_args(false);
  command->add_flag("--webhook-private", options->webhook_private,
                    "Let webhooks call addresses that are not public (this machine, its network)");
  command->add_flag("--log-json", options->log_json, "Log lines as JSON");
  command->add_option("--log", options->log_file,
                      "File of the log, which SIGHUP and SIGUSR1 open again after it was renamed "
                      "(default: stderr, in a container stdout)");
  command->add_flag(
      "--insecure", options->insecure,
      "Listen on addresses that other machines can reach while there are no keys: anyone who "
      "reaches them may do everything");
  command->callback([options, executor] {
    options->executor = executor->name;
    options->slurm = executor->slurm;
    options->scenarios = world::scenarios_folder();
    server::serve(*options);
  });
}

}  // namespace throng::cli
