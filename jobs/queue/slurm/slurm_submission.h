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

/// Tasks of an array job; no more than a controller takes with its default MaxArraySize.
inline constexpr std::size_t kMaxArrayTasks = 1000;

/// The needs of one task: those of an array need the same.
struct SlurmNeed {
  std::int64_t memory_mib = 0;    ///< 0: the partition's default
  std::int64_t estimate_mib = 0;  ///< of the task's memory, from which memory_mib comes; rounded up
  bool renders = false;
  auto operator<=>(const SlurmNeed&) const = default;
};

/// `estimate_mib` as of Share::memory_mib; `doublings` of memory, one per time that it ran out.
SlurmNeed slurm_need(const Task& task, std::int64_t estimate_mib, int doublings,
                     const SlurmOptions& options);

/// Environment variables of workers with this need.
std::vector<std::pair<std::string, std::string>> task_variables(const SlurmNeed& need,
                                                                const SlurmOptions& options);

/// For a priority of -100 to 100: higher ones are less nice. Only administrators may be less nice
/// than 0.
int nice_value(int priority);

/// "throng-0f3a…": the array job's name.
std::string slurm_job_name(const std::string& array);

/// sbatch with its arguments, for `count` tasks.
std::vector<std::string> submission_words(const JobFolder& folder, const std::string& array,
                                          std::size_t count, const SlurmNeed& need, int nice,
                                          const SlurmOptions& options);

/// sbatch that only asks whether such a job could run: partition, account and limits.
std::vector<std::string> test_submission(const SlurmOptions& options);

/// The text as one word of a shell.
std::string quoted_for_shell(const std::string& text);

}  // namespace throng::jobs
