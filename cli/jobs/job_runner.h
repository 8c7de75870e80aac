// Functions that `throng run` and `throng render` share: run the job of a folder with a progress
// bar, until Ctrl-C.
#pragma once

#include <CLI/CLI.hpp>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "jobs/pipeline/checks/resolve.h"
#include "jobs/queue/dataset/folder.h"
#include "jobs/queue/executors.h"
#include "spec/job/resolved_job.h"

namespace throng::cli {

struct JobArguments {
  std::string job_file;
  std::string output;
  int workers = 0;
  jobs::ExecutorOptions executor = {};
  bool profile = false;
  std::string publish;  ///< replaces the job's outputs.publish unless ""
};

/// Adds the options JOB, --output, --workers, --profile, --publish, and those of executors.
/// `arguments` must outlive the command.
void add_job_options(CLI::App& command, JobArguments& arguments);

/// The job file's document, with calibration files that it names replaced by their cameras. Throws
/// InputError if the file does not exist or is not a job.
nlohmann::json load_job_document(const std::string& path);

/// Reads the job file and resolves the job. Throws InputError, also if the file does not exist.
jobs::ResolvedJob read_job_file(
    const std::string& path, jobs::DefaultDrones default_drones = jobs::DefaultDrones::of_scenario);

/// The job with the address of --publish, if that is given. Checks in advance whether a dataset can
/// be uploaded there, unless the output folder holds the dataset already. Throws InputError and
/// EnvironmentError.
jobs::ResolvedJob with_target(const jobs::ResolvedJob& resolved, const JobArguments& arguments);

/// Runs the folder's job, then prints the path of the dataset and, with --profile, the times of the
/// stages. Throws as jobs::run_job().
void finish_job(const jobs::JobFolder& folder, const jobs::ResolvedJob& resolved,
                const JobArguments& arguments);

}  // namespace throng::cli
