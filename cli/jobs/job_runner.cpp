#include "cli/jobs/job_runner.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/files/files.h"
#include "base/text/words.h"
#include "cli/jobs/executor_options.h"
#include "cli/shell/document_kind.h"
#include "cli/shell/input_file.h"
#include "cli/shell/interrupt.h"
#include "cli/shell/progress_bar.h"
#include "jobs/bucket/publish.h"
#include "jobs/pipeline/checks/resolve.h"
#include "jobs/queue/dataset/run_warnings.h"
#include "jobs/queue/delivery.h"
#include "jobs/queue/executors.h"
#include "jobs/queue/machine_speed.h"
#include "jobs/queue/profile.h"
#include "jobs/queue/supervisor.h"
#include "spec/bucket/address.h"
#include "spec/calibration/calibrations.h"
#include "spec/calibration/foreign/read_camera_file.h"
#include "spec/estimates/task_memory.h"
#include "spec/job/spec.h"
#include "world/scenario.h"

namespace throng::cli {

namespace {

// Simulating is quick beside drawing; a tenth of a run's bar is near enough.
constexpr double kSimulationShare = 0.1;

double done_fraction(const jobs::RunProgress& run) {
  const double simulated = run.duration_s > 0 ? run.simulated_s / run.duration_s : 0;
  const double drawn =
      run.images_total > 0 ? static_cast<double>(run.images_done) / run.images_total : 0;
  return kSimulationShare * simulated + (1 - kSimulationShare) * drawn;
}

void show_job(ProgressBar& bar, const jobs::JobProgress& progress) {
  if (progress.delivery && progress.delivery->bytes_total > 0) {
    const jobs::DeliveryProgress& delivery = *progress.delivery;
    return bar.show(
        static_cast<double>(delivery.bytes_done) / static_cast<double>(delivery.bytes_total),
        "publishing " + format_megabytes(delivery.bytes_done, delivery.bytes_total));
  }
  double fraction = 0;
  std::int64_t done = 0;
  std::int64_t total = 0;
  for (const jobs::RunProgress& run : progress.runs) {
    fraction += done_fraction(run) / static_cast<double>(progress.runs.size());
    done += run.images_done;
    total += run.images_total;
  }
  bar.show(fraction,
           done == 0 ? std::string("simulating") : fmt::format("{} of {} frames", done, total));
}

std::unique_ptr<jobs::Executor> made_executor(const JobArguments& arguments) {
  jobs::ExecutorOptions options = arguments.executor;
  options.local.workers = arguments.workers;
  options.slurm.at_once = arguments.workers;
  const jobs::ExecutorKind& kind = jobs::executor_kind(options.name);
  if (const std::string problem = kind.check(options); !problem.empty()) {
    fmt::print(stderr, "throng: {}: {}; waiting for an answer\n", kind.name, problem);
  }
  return kind.make(options);
}

/// Needs of tasks by estimate, and what they wait for.
jobs::Share job_share(const jobs::ResolvedJob& job) {
  jobs::Share share;
  share.memory_mib = [memory = jobs::TaskMemory(job.spec(), job.load())](const jobs::Task& task) {
    return memory.mib_of(task);
  };
  share.on_wait = [](const std::string& reason) {
    if (!reason.empty()) fmt::print(stderr, "\nthrong: {}\n", reason);
  };
  share.speed_file = jobs::user_speed_file();
  return share;
}

void print_warnings(const std::vector<std::string>& warnings) {
  constexpr std::size_t kMaxPrinted = 12;
  for (std::size_t i = 0; i < std::min(warnings.size(), kMaxPrinted); ++i) {
    fmt::print(stderr, "throng: warning: {}\n", warnings[i]);
  }
  if (warnings.size() > kMaxPrinted) {
    fmt::print(stderr, "throng: and {} more, in work/RUN/*.warnings.json\n",
               counted(warnings.size() - kMaxPrinted, "warning"));
  }
}

}  // namespace

void add_job_options(CLI::App& command, JobArguments& arguments) {
  command.add_option("job", arguments.job_file, "Job file (JSON; see docs/job.md)")->required();
  command
      .add_option(
          "-o,--output", arguments.output,
          "Folder for the dataset/ and the intermediate files; an interrupted job is resumed")
      ->required();
  command
      .add_option("--workers", arguments.workers,
                  "Parallel worker processes (0: one per core; in Slurm any number)")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command.add_flag("--profile", arguments.profile,
                   "Print a profile of rendering, labeling and writing");
  command.add_option(
      "--publish", arguments.publish,
      "Bring the finished dataset to an object store, s3://BUCKET/PREFIX, instead of "
      "where outputs.publish of the job says");
  add_executor_options(command, arguments.executor);
}

nlohmann::json load_job_document(const std::string& path) {
  nlohmann::json job = jobs::parse_job_document(read_job_document(path), path);
  // A calibration is a file, named from where the job's file is.
  const auto camera_in = [&](const std::string& name) {
    const std::filesystem::path file = std::filesystem::path(path).parent_path() / name;
    return calibrate::to_json(calibrate::read_camera_file(file));
  };
  try {
    jobs::put_calibrations(job, camera_in);
    return job;
  } catch (const InputError& error) {
    std::vector<Problem> problems = error.problems();
    for (Problem& problem : problems) {
      if (problem.source.empty()) problem.source = path;
    }
    throw InputError(std::move(problems));
  }
}

jobs::ResolvedJob read_job_file(const std::string& path, jobs::DefaultDrones default_drones) {
  return jobs::resolve_job(load_job_document(path), path, world::scenarios_folder(),
                           default_drones);
}

jobs::ResolvedJob with_target(const jobs::ResolvedJob& resolved, const JobArguments& arguments) {
  jobs::JobSpec job = resolved.spec();
  if (!arguments.publish.empty()) {
    job.outputs.publish = bucket::parse_address(arguments.publish, "--publish", "").text();
  }
  const bool has_dataset = std::filesystem::exists(jobs::JobFolder(arguments.output).dataset());
  if (!job.outputs.publish.empty() && !has_dataset) {
    bucket::check_target(bucket::parse_address(job.outputs.publish, "", "/outputs/publish"));
  }
  return jobs::ResolvedJob(std::move(job), resolved.load());
}

void finish_job(const jobs::JobFolder& folder, const jobs::ResolvedJob& resolved,
                const JobArguments& arguments) {
  const jobs::JobSpec& job = resolved.spec();
  if (arguments.profile) ::setenv(jobs::kProfileVariable, "1", 1);
  std::vector<jobs::RunFailure> failures;
  {
    const Interrupt interrupt;
    ProgressBar bar(job.name.empty() ? "job" : job.name);
    const std::unique_ptr<jobs::Executor> executor = made_executor(arguments);
    failures = jobs::run_job(
        folder, resolved, *executor,
        [&](const jobs::JobProgress& progress) { show_job(bar, progress); }, interrupt.token(),
        job_share(resolved));
  }
  print_warnings(jobs::kept_warnings(folder, job.runs));
  fmt::print("{}\n", folder.dataset().string());
  if (const auto delivery = jobs::read_delivery(folder)) {
    fmt::print("{}: {} objects, {} bytes\n", delivery->address, delivery->objects, delivery->bytes);
  }
  if (failures.empty()) {
    if (arguments.profile) fmt::print("{}", jobs::profile_table(folder, job));
    return;
  }
  std::string message = fmt::format(
      "{} of {} runs failed and are not in the dataset; the same command tries them again",
      failures.size(), job.runs);
  for (const jobs::RunFailure& failure : failures) message += "\n" + failure.message;
  throw EnvironmentError(message);
}

}  // namespace throng::cli
