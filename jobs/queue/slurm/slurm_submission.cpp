#include "jobs/queue/slurm/slurm_submission.h"

#include <fmt/core.h>

#include <algorithm>

#include "jobs/queue/confine/worker_limits.h"
#include "jobs/queue/slurm/slurm_controller.h"
#include "jobs/queue/workers/attempts.h"

namespace throng::jobs {

namespace {

// Tasks of almost the same need share an array.
constexpr std::int64_t kStepMib = 512;

std::int64_t rounded_up(std::int64_t mib) { return (mib + kStepMib - 1) / kStepMib * kStepMib; }

void add_resources(std::vector<std::string>& command, const SlurmNeed& need,
                   const SlurmOptions& options) {
  const auto add = [&](const char* name, const std::string& value) {
    if (!value.empty()) command.push_back(fmt::format("--{}={}", name, value));
  };
  add("partition", options.partition);
  add("account", options.account);
  add("time", options.time);
  add("cpus-per-task", std::to_string(options.cpus));
  if (need.memory_mib > 0) add("mem", fmt::format("{}M", need.memory_mib));
  if (need.renders) add("gres", options.gres);
  command.insert(command.end(), {"--nodes=1", "--ntasks=1"});
  command.insert(command.end(), options.more.begin(), options.more.end());
}

}  // namespace

SlurmNeed slurm_need(const Task& task, std::int64_t estimate_mib, int doublings,
                     const SlurmOptions& options) {
  // Threads' stacks, the driver and pages of files, which count where cgroups limit memory.
  constexpr std::int64_t kMoreMib = 512;
  constexpr int kMaxDoublings = 4;
  SlurmNeed need;
  need.renders = task.kind == Task::Kind::render;
  need.estimate_mib = estimate_mib > 0 ? rounded_up(estimate_mib) : 0;
  std::int64_t mib = need.estimate_mib > 0 ? need.estimate_mib + kMoreMib : 0;
  mib = std::max(mib, options.memory_mib);
  need.memory_mib = mib << std::min(doublings, kMaxDoublings);
  return need;
}

std::vector<std::pair<std::string, std::string>> task_variables(const SlurmNeed& need,
                                                                const SlurmOptions& options) {
  // Mesa's software renderer would start a thread per core of the node.
  std::vector<std::pair<std::string, std::string>> variables = {
      {"LP_NUM_THREADS", options.cpus > 1 ? std::to_string(options.cpus) : "0"}};
  if (options.worker_memory_mib > 0) {
    variables.emplace_back(kMemoryVariable, std::to_string(options.worker_memory_mib));
  } else if (options.limits_by_need && need.estimate_mib > 0) {
    constexpr std::int64_t kMoreMib = 2048;
    const std::int64_t limit = std::max(2 * need.estimate_mib + kMoreMib, need.memory_mib);
    variables.emplace_back(kDataVariable, std::to_string(limit));
  }
  return variables;
}

int nice_value(int priority) {
  constexpr int kMaxPriority = 100;
  return std::max(0, kMaxPriority - priority);
}

std::string slurm_job_name(const std::string& array) { return kSlurmPrefix + array; }

std::string quoted_for_shell(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) {
    if (c == '\'') {
      quoted += "'\\''";
    } else {
      quoted += c;
    }
  }
  return quoted + "'";
}

std::vector<std::string> submission_words(const JobFolder& folder, const std::string& array,
                                          std::size_t count, const SlurmNeed& need, int nice,
                                          const SlurmOptions& options) {
  std::string indices = fmt::format("0-{}", count - 1);
  if (options.at_once > 0) indices += fmt::format("%{}", options.at_once);
  std::string script = "exec";
  for (const std::string& word : options.command) script += " " + quoted_for_shell(word);
  script += fmt::format(" --job {} --array {}", quoted_for_shell(folder.path().string()), array);
  // A percent sign begins a placeholder in names of files.
  std::string output = (array_folder(folder, array) / "out").string();
  for (auto at = output.find('%'); at != std::string::npos; at = output.find('%', at + 2)) {
    output.insert(at, "%");
  }
  // Slurm itself restarts nothing: a restart is a new attempt, with a folder of its own.
  std::vector<std::string> command = {"sbatch",
                                      "--parsable",
                                      "--no-requeue",
                                      "--job-name=" + slurm_job_name(array),
                                      "--array=" + indices,
                                      fmt::format("--nice={}", nice),
                                      "--chdir=" + folder.path().string(),
                                      "--open-mode=append",
                                      "--output=" + output + "/%a.log"};
  add_resources(command, need, options);
  command.push_back("--wrap=" + script);
  return command;
}

std::vector<std::string> test_submission(const SlurmOptions& options) {
  std::vector<std::string> command = {"sbatch", "--test-only"};
  add_resources(command, {options.memory_mib, 0, true}, options);
  command.emplace_back("--wrap=true");
  return command;
}

}  // namespace throng::jobs
