// Shared by `throng run` and `throng render`: a job folder worked off, with a progress bar and
// Ctrl-C.
#pragma once

#include <CLI/CLI.hpp>
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
  std::string publish;  ///< instead of the job's outputs.publish; "": that
};

/// The options JOB, --output, --workers, --profile, --publish, and those of executors.
void add_job_options(CLI::App& command, JobArguments& arguments);

/// The job file's text, with the cameras of the calibration files that it names. Throws InputError
/// if there is no such file, or it holds something else.
std::string read_job_text(const std::string& path);

/// Reads the job file and resolves the job. Throws InputError (also when there is no such file).
jobs::ResolvedJob read_job_file(
    const std::string& path, jobs::DefaultDrones default_drones = jobs::DefaultDrones::of_scenario);

/// The job with the address of --publish, if that is given. Before anything is written or
/// simulated, it looks whether a dataset can be brought there, unless the output folder holds it
/// already. Throws InputError and EnvironmentError.
jobs::ResolvedJob with_target(const jobs::ResolvedJob& resolved, const JobArguments& arguments);

/// Works the folder's job off, then prints where the dataset is, and where the time went if asked
/// for. Throws like jobs::run_job.
void finish_job(const jobs::JobFolder& folder, const jobs::ResolvedJob& resolved,
                const JobArguments& arguments);

}  // namespace throng::cli
