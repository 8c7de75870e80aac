// The command that submits tasks as an array job.
#pragma once

#include <compare>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "jobs/queue/dataset/folder.h"
#include "jobs/queue/slurm/slurm_options.h"
#include "spec/job/plan.h"

namespace throng::jobs {

/// Max number of tasks in an array job: within the controller's default MaxArraySize of 1001.
inline constexpr std::size_t kMaxArrayTasks = 1000;

/// Resources of one task; all tasks of an array have equal needs.
struct SlurmNeed {
  std::int64_t memory_mib = 0;    ///< memory to request; 0: the partition's default
  std::int64_t estimate_mib = 0;  ///< Share::memory_mib, rounded up to 512; 0: unknown
  bool renders = false;           ///< whether it needs SlurmOptions::gres
  auto operator<=>(const SlurmNeed&) const = default;
};

/// The need of a task with the estimate Share::memory_mib. `doublings` is the number of attempts
/// that ran out of memory; the request doubles with each, up to four times.
SlurmNeed slurm_need(const Task& task, std::int64_t estimate_mib, int doublings,
                     const SlurmOptions& options);

/// Environment variables of the workers of tasks with this need.
std::vector<std::pair<std::string, std::string>> task_variables(const SlurmNeed& need,
                                                                const SlurmOptions& options);

/// Slurm's nice value for a priority of -100 to 100: 100 - priority, since only administrators may
/// use negative nice values.
int nice_value(int priority);

/// The name of an array job: "throng-" and the array's name.
std::string slurm_job_name(const std::string& array);

/// sbatch with its arguments, to submit the first `count` indices of an array.
std::vector<std::string> submission_words(const JobFolder& folder, const std::string& array,
                                          std::size_t count, const SlurmNeed& need, int nice,
                                          const SlurmOptions& options);

/// sbatch with its arguments, to check partition, account and limits without submitting a job.
std::vector<std::string> test_submission(const SlurmOptions& options);

/// The text quoted as one word of a POSIX shell.
std::string quoted_for_shell(const std::string& text);

}  // namespace throng::jobs
