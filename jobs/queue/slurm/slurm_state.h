// States of Slurm's jobs, parsed from the output of its programs, and their meaning for an attempt
// at a task. Pure functions, for Slurm 20.11 and later.
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
  std::string node;    ///< "" until a node is allocated
  std::string reason;  ///< why it waits or has ended: "Resources", "NonZeroExitCode"
  ExitStatus status = {};
};

/// The argument of squeue's --Format that read_queue() expects.
inline constexpr const char* kQueueFormat =
    "ArrayJobID:|,ArrayTaskID:|,State:|,NodeList:|,Reason:|,exit_code:|,Name:|";

/// The tasks of array jobs whose names begin with `prefix`, from `squeue --noheader --array`.
/// Lines that are no such task are left out.
std::vector<SlurmTask> read_queue(const std::string& text, std::string_view prefix);

/// The argument of sacct's -o that read_accounting() expects.
inline constexpr const char* kAccountFormat = "JobID,State,ExitCode,NodeList,JobName";

/// State, status and node of the tasks of the array job with this name, by index, from
/// `sacct -n -P -X`. Waiting tasks share one line ("12_[5-9,11%4]").
std::map<int, SlurmTask> read_accounting(const std::string& text, const std::string& name);

/// The number of a submitted job, from `sbatch --parsable`; "" if the text has none.
std::string read_submission(const std::string& text);

/// Whether sbatch refused an array because it exceeds the cluster's MaxArraySize.
bool is_array_too_large(std::string_view output);

/// Whether a program of Slurm failed because the controller cannot be reached or is overloaded,
/// rather than because it refuses the request.
bool is_controller_away(std::string_view output);

/// State of an attempt, derived from Slurm's states.
enum class SlurmFate {
  waiting,
  running,
  completed,
  failed,         ///< by its exit status
  out_of_memory,  ///< exceeded the requested memory
  timed_out,      ///< exceeded the requested time
  preempted,      ///< ended in favor of other jobs
  lost,           ///< its node failed, or it could not be launched
  cancelled,      ///< by somebody
};

SlurmFate interpret_fate(const SlurmTask& task);

/// Whether a task that was running waits for a restart under its number, by `--requeue` or an
/// administrator. A suspended task does not: it continues.
bool is_requeued(const SlurmTask& task);

/// Whether the task did not cause this end; its next attempt does not count as a further one.
bool is_blameless(SlurmFate fate);

/// Outcome and message of an attempt that ended; `error` is the worker's own message, `log` its
/// log.
TaskResult result_of_slurm(const SlurmTask& task, const std::optional<WorkerError>& error,
                           const std::filesystem::path& log);

}  // namespace throng::jobs
