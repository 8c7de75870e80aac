// throng check: everything that can be said of a job before it runs.
#include <fmt/core.h>
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <system_error>
#include <thread>

#include "cli/jobs/job_runner.h"
#include "cli/shell/commands.h"
#include "cli/shell/job_summary.h"
#include "jobs/pipeline/checks/job_check.h"
#include "jobs/queue/machine_speed.h"
#include "spec/estimates/job_cost.h"
#include "world/scenario.h"

namespace throng::cli {

void add_check(CLI::App& app) {
  auto* command = app.add_subcommand(
      "check", "Check a job and estimate images, time, disk and memory; runs nothing");
  const auto file = std::make_shared<std::string>();
  const auto as_json = std::make_shared<bool>(false);
  command->add_option("job", *file, "Job file (JSON; see docs/job.md)")->required();
  command->add_flag("--json", *as_json, "Print the answer of the HTTP dry run (docs/api.md)");
  command->footer("Exit code 0 with warnings, 2 with errors.");
  command->callback([file, as_json] {
    nlohmann::json answer =
        to_json(jobs::check_job(load_job_document(*file), *file, world::scenarios_folder()));
    jobs::fit_to_machine(answer, jobs::user_speed_file());
    const std::filesystem::path here = std::filesystem::current_path();
    std::error_code error;  // a disk that cannot be measured has the largest number free
    jobs::warn_of_full_disk(answer,
                            static_cast<double>(std::filesystem::space(here, error).available),
                            "the disk of " + here.string());
    if (*as_json) {
      fmt::print("{}\n", answer.dump(2));
    } else {
      print_job_summary(answer, *file,
                        std::max(1, static_cast<int>(std::thread::hardware_concurrency())));
    }
  });
}

}  // namespace throng::cli
