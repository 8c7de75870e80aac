#include "cli/jobs/executor_options.h"

#include <fmt/core.h>

#include <iterator>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace throng::cli {

namespace {

/// The words of a program and its first arguments, and that of the command for workers.
std::vector<std::string> worker_command(const std::string& program) {
  std::istringstream text(program);
  std::vector<std::string> words(std::istream_iterator<std::string>(text), {});
  words.emplace_back("worker");
  return words;
}

}  // namespace

void add_executor_options(CLI::App& command, jobs::ExecutorOptions& options) {
  std::set<std::string> names;
  std::string help = "Machines that run tasks";
  for (const jobs::ExecutorKind& kind : jobs::executor_kinds()) {
    help += fmt::format("{} {} ({})", names.empty() ? ":" : ",", kind.name, kind.help);
    names.insert(kind.name);
  }
  command.add_option("--executor", options.name, help)
      ->check(CLI::IsMember(names))
      ->capture_default_str();
  jobs::SlurmOptions& slurm = options.slurm;
  command.add_option("--slurm-partition", slurm.partition, "Partition of Slurm for all tasks");
  command.add_option("--slurm-account", slurm.account, "Account of Slurm that pays for them");
  command.add_option("--slurm-time", slurm.time,
                     "The longest that a task may take in Slurm, as sbatch reads it: 30, 2:00:00");
  command
      .add_option("--slurm-memory", slurm.memory_mib,
                  "MiB of memory that Slurm gives a task at least (0: by its estimate)")
      ->check(CLI::NonNegativeNumber);
  command.add_option("--slurm-cpus", slurm.cpus, "CPUs that Slurm gives a task")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command.add_option("--slurm-gres", slurm.gres,
                     "Resources that Slurm gives tasks that render, e.g. gpu:1");
  command
      .add_option("--slurm-option", slurm.more,
                  "A further option of sbatch, e.g. --slurm-option=--qos=low; repeatable")
      ->allow_extra_args(false);
  command.add_option_function<std::string>(
      "--slurm-program",
      [&slurm](const std::string& text) { slurm.command = worker_command(text); },
      "The program as the nodes know it, e.g. \"apptainer exec /shared/throng.sif throng\" "
      "(default: this program's path)");
  command.add_option("--slurm-poll", slurm.poll_s, "Seconds between two looks at Slurm's queue")
      ->check(CLI::Range(0.5, 600.0))
      ->capture_default_str();
  command
      .add_option("--slurm-lease", slurm.lease_s,
                  "Seconds without a sign of life after which a task is tried elsewhere")
      ->check(CLI::Range(10.0, 86400.0))
      ->capture_default_str();
}

}  // namespace throng::cli
