// States of Slurm's jobs, read from the output of its programs, and their meaning for an attempt at
// a task. Pure functions; written for Slurm 20.11 and later.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "jobs/queue/confine/child_process.h"
#include "jobs/queue/workers/executor.h"
#include "jobs/queue/workers/worker_messages.h"

namespace throng::jobs {

/// One task of an array job.
struct SlurmTask {
  std::string job;     ///< number of the array job
  int index = 0;       ///< in the array
  std::string name;    ///< of the job
  std::string state;   ///< "RUNNING", "NODE_FAIL"
  std::string node;    ///< "" until it has one
  std::string reason;  ///< why it waits or has ended: "Resources", "NonZeroExitCode"
  ExitStatus status = {};
};

/// The argument of squeue's --Format by which read_queue() reads.
inline constexpr const char* kQueueFormat =
    "ArrayJobID:|,ArrayTaskID:|,State:|,NodeList:|,Reason:|,exit_code:|,Name:|";

/// The tasks of array jobs whose names begin with `prefix`, from `squeue --noheader --array`.
/// Lines that are no such task are left out.
std::vector<SlurmTask> read_queue(const std::string& text, std::string_view prefix);

/// The argument of sacct's -o by which read_accounting() reads.
inline constexpr const char* kAccountFormat = "JobID,State,ExitCode,NodeList,JobName";

/// State, status and node of the tasks of an array job of this name, by their indices, from
/// `sacct -n -P -X`. Tasks that wait have one line together ("12_[5-9,11%4]").
std::map<int, SlurmTask> read_accounting(const std::string& text, const std::string& name);

/// The number of a submitted job, from `sbatch --parsable`; "" when there is none.
std::string read_submission(const std::string& text);

/// Whether sbatch refused an array for its size: the cluster's MaxArraySize is smaller.
bool is_array_too_large(std::string_view output);

/// Whether a program of Slurm failed because the controller cannot be reached or has no room now,
/// rather than because it refuses what was asked.
bool is_controller_away(std::string_view output);

/// The fate of an attempt.
enum class SlurmFate {
  waiting,
  running,
  completed,
  failed,         ///< by its exit status
  out_of_memory,  ///< of what was asked for
  timed_out,      ///< of the time that was asked for
  preempted,      ///< its place went to others
  lost,           ///< its node failed, or it could not be launched
  cancelled,      ///< by somebody
};

SlurmFate interpret_fate(const SlurmTask& task);

/// Whether a task that was running waits to be begun again under its number: by `--requeue`, or an
/// administrator. One that is suspended goes on.
bool is_requeued(const SlurmTask& task);

/// Whether the task did nothing to end like that: it is tried again as if it had not been begun.
bool is_blameless(SlurmFate fate);

/// Outcome and message of an attempt that ended; `error` is what its worker said of itself.
TaskResult result_of_slurm(const SlurmTask& task, const std::optional<WorkerError>& error,
                           const std::filesystem::path& log);

}  // namespace throng::jobs
