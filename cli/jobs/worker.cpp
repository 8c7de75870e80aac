// throng worker: one task of a job, for its supervisor.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <memory>

#include "base/error.h"
#include "base/files/files.h"
#include "cli/jobs/job_report.h"
#include "cli/jobs/processes.h"
#include "jobs/queue/workers/worker_interface.h"
#include "jobs/study/service_work.h"

namespace throng::cli {

namespace {

void write_report(const jobs::JobFolder& folder, const std::string& /*name*/,
                  const jobs::OnTaskProgress& /*on_progress*/) {
  write_file_atomically(folder.output_of({jobs::Task::Kind::report}), report_of_job(folder.path()));
}

void simulate_of_study(const jobs::JobFolder& folder, const std::string& name,
                       const jobs::OnTaskProgress& on_progress) {
  study::simulate_in(folder.path(), std::stoul(name.substr(name.find('/') + 1)));
  on_progress({1, 1, {}});
}

void report_of_study(const jobs::JobFolder& folder, const std::string& /*name*/,
                     const jobs::OnTaskProgress& /*on_progress*/) {
  study::report_in(folder.path());
}

jobs::OtherTasks tasks_outside_of_plans() {
  return {{jobs::kStudyRunName, &simulate_of_study},
          {jobs::to_string({jobs::Task::Kind::study_report}), &report_of_study},
          {jobs::to_string({jobs::Task::Kind::report}), &write_report}};
}

/// An attempt on a cluster's node: its supervisor reads the messages and the end from files.
int run_attempt(const std::string& job_folder, const std::string& array,
                const jobs::OtherTasks& others) {
  const char* index = std::getenv("SLURM_ARRAY_TASK_ID");
  if (index == nullptr) {
    throw InputError(
        Problem{"--array", "$SLURM_ARRAY_TASK_ID", "not set", "an index, as Slurm sets it"});
  }
  std::string task;
  try {
    task = jobs::begin_attempt(job_folder, array, std::atoi(index));
  } catch (const EnvironmentError& error) {
    fmt::print(stderr, "throng: {}\n", error.what());
    return jobs::worker_not_begun;
  }
  const int code = jobs::run_worker(job_folder, task, others);
  jobs::end_attempt(job_folder, code);
  return code;
}

}  // namespace

void add_worker(CLI::App& app, const jobs::OtherTasks& others) {
  struct Arguments {
    std::string job_folder;
    std::string task;
    std::string array;
  };
  auto* command =
      app.add_subcommand("worker", "Run one task of a job folder (started by run and serve)");
  const auto arguments = std::make_shared<Arguments>();
  command->add_option("--job", arguments->job_folder, "The job's folder")->required();
  auto* task =
      command->add_option("--task", arguments->task, "The task's name, e.g. run000/shard0003");
  auto* array = command->add_option(
      "--array", arguments->array,
      "Instead of --task: an array of the folder's attempts/; the index is $SLURM_ARRAY_TASK_ID");
  task->excludes(array);
  // The worker's exit codes: its supervisor retries only where that makes sense.
  jobs::OtherTasks all = tasks_outside_of_plans();
  all.insert(others.begin(), others.end());
  command->callback([arguments, all] {
    if (arguments->array.empty()) {
      if (arguments->task.empty()) throw CLI::RequiredError("--task or --array");
      std::exit(jobs::run_worker(arguments->job_folder, arguments->task, all));
    }
    std::exit(run_attempt(arguments->job_folder, arguments->array, all));
  });
}

}  // namespace throng::cli
