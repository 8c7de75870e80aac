// throng worker: one task of a job, for its supervisor.
#include <CLI/CLI.hpp>
#include <cstdlib>
#include <memory>

#include "base/files.h"
#include "calibrate/request.h"
#include "cli/commands.h"
#include "cli/job_report.h"
#include "jobs/pipeline/worker.h"
#include "study/service_work.h"

namespace throng::cli {

namespace {

void calibrate_in(const jobs::JobFolder& folder, const std::string& /*name*/,
                  const jobs::OnTaskProgress& on_progress) {
  calibrate::carry_out_in(folder.path(),
                          [&](double share, const std::string& what) {
                            on_progress({share, 1, what});
                          },
                          {});
}

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

jobs::OtherTasks other_tasks() {
  return {{jobs::kStudyRunName, &simulate_of_study},
          {jobs::name_of({jobs::Task::Kind::study_report}), &report_of_study},
          {jobs::name_of({jobs::Task::Kind::calibrate}), &calibrate_in},
          {jobs::name_of({jobs::Task::Kind::report}), &write_report}};
}

}  // namespace

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
  command->callback([arguments] {
    std::exit(jobs::run_worker(arguments->job_folder, arguments->task, other_tasks()));
  });
}

}  // namespace throng::cli
