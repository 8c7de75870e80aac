#include "jobs/queue/slurm/slurm_state.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <csignal>
#include <sstream>
#include <utility>

#include "jobs/queue/workers/worker_exit.h"
#include "jobs/queue/workers/worker_protocol.h"

namespace throng::jobs {

namespace {

std::vector<std::string> split(const std::string& line, char separator) {
  std::vector<std::string> parts;
  std::istringstream text(line);
  for (std::string part; std::getline(text, part, separator);) parts.push_back(part);
  return parts;
}

std::optional<int> number_in(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// 3 of "12_3"; 5, 6, 9 of "12_[5-6,9%4]".
std::vector<int> indices_in(const std::string& job) {
  std::vector<int> indices;
  const auto underscore = job.find('_');
  if (underscore == std::string::npos) return indices;
  std::string list = job.substr(underscore + 1);
  if (list.starts_with('[')) list = list.substr(1, list.find_first_of("%]") - 1);
  for (const std::string& range : split(list, ',')) {
    const auto dash = range.find('-');
    const std::optional<int> first = number_in(range.substr(0, dash));
    const std::optional<int> last =
        dash == std::string::npos ? first : number_in(range.substr(dash + 1));
    constexpr int kMaxIndex = 1 << 20;
    if (!first || !last || *last >= kMaxIndex) continue;
    for (int index = *first; index <= *last; ++index) indices.push_back(index);
  }
  return indices;
}

/// As wait() gives it: the signal in the lowest seven bits, the exit code in the next eight.
ExitStatus to_exit_status(int raw) {
  constexpr int kSignalBits = 0x7f;
  constexpr int kCodeShift = 8;
  constexpr int kCodeBits = 0xff;
  return {(raw >> kCodeShift) & kCodeBits, raw & kSignalBits};
}

using StateFate = std::pair<std::string_view, SlurmFate>;
// "Job state codes" of the manual of squeue.
constexpr std::array kFates = {
    StateFate{"PENDING", SlurmFate::waiting},
    StateFate{"CONFIGURING", SlurmFate::waiting},
    StateFate{"REQUEUED", SlurmFate::waiting},
    StateFate{"REQUEUE_FED", SlurmFate::waiting},
    StateFate{"RESV_DEL_HOLD", SlurmFate::waiting},
    StateFate{"SUSPENDED", SlurmFate::waiting},
    StateFate{"STOPPED", SlurmFate::waiting},
    StateFate{"RUNNING", SlurmFate::running},
    StateFate{"COMPLETING", SlurmFate::running},
    StateFate{"RESIZING", SlurmFate::running},
    StateFate{"SIGNALING", SlurmFate::running},
    StateFate{"STAGE_OUT", SlurmFate::running},
    StateFate{"COMPLETED", SlurmFate::completed},
    StateFate{"FAILED", SlurmFate::failed},
    StateFate{"SPECIAL_EXIT", SlurmFate::failed},
    StateFate{"OUT_OF_MEMORY", SlurmFate::out_of_memory},
    StateFate{"TIMEOUT", SlurmFate::timed_out},
    StateFate{"DEADLINE", SlurmFate::timed_out},
    StateFate{"PREEMPTED", SlurmFate::preempted},
    StateFate{"NODE_FAIL", SlurmFate::lost},
    StateFate{"BOOT_FAIL", SlurmFate::lost},
    StateFate{"LAUNCH_FAILED", SlurmFate::lost},
    StateFate{"RECONFIG_FAIL", SlurmFate::lost},
    StateFate{"REVOKED", SlurmFate::lost},
    StateFate{"REQUEUE_HOLD", SlurmFate::lost},
    StateFate{"CANCELLED", SlurmFate::cancelled},
};

}  // namespace

std::vector<SlurmTask> read_queue(const std::string& text, std::string_view prefix) {
  constexpr std::size_t kFields = 7;
  std::vector<SlurmTask> tasks;
  for (const std::string& line : split(text, '\n')) {
    const std::vector<std::string> fields = split(line, '|');
    if (fields.size() < kFields || !fields[6].starts_with(prefix)) continue;
    const std::optional<int> index = number_in(fields[1]);
    if (!index || !number_in(fields[0])) continue;
    SlurmTask task{fields[0], *index, fields[6], fields[2], fields[3], fields[4]};
    task.status = to_exit_status(number_in(fields[5]).value_or(0));
    tasks.push_back(std::move(task));
  }
  return tasks;
}

std::map<int, SlurmTask> read_accounting(const std::string& text, const std::string& name) {
  constexpr std::size_t kFields = 5;
  std::map<int, SlurmTask> tasks;
  for (const std::string& line : split(text, '\n')) {
    const std::vector<std::string> fields = split(line, '|');
    // Numbers of jobs come again when a controller has lost its state.
    if (fields.size() < kFields || fields[1].empty() || fields[4] != name) continue;
    const std::vector<std::string> codes = split(fields[2], ':');
    if (codes.size() != 2 || !number_in(codes[0]) || !number_in(codes[1])) continue;
    SlurmTask task;
    task.job = fields[0].substr(0, fields[0].find('_'));
    task.name = name;
    // "CANCELLED by 1000"
    task.state = fields[1].substr(0, fields[1].find(' '));
    task.status = {*number_in(codes[0]), *number_in(codes[1])};
    task.node = fields[3];
    for (const int index : indices_in(fields[0])) {
      task.index = index;
      tasks.insert_or_assign(index, task);
    }
  }
  return tasks;
}

std::string read_submission(const std::string& text) {
  for (const std::string& line : split(text, '\n')) {
    const std::string number = line.substr(0, line.find(';'));  // "12;cluster"
    if (number_in(number)) return number;
  }
  return "";
}

bool is_array_too_large(std::string_view output) {
  return output.find("Invalid job array specification") != std::string_view::npos;
}

bool is_controller_away(std::string_view output) {
  // Messages of Slurm's slurm_errno.c, and of munge, without which no program can talk to the
  // controller.
  static constexpr std::array kTexts = {"Unable to contact slurm controller",
                                        "Socket timed out",
                                        "Connection refused",
                                        "Connection timed out",
                                        "connect failure",
                                        "Communication connection",
                                        "Zero Bytes were transmitted",
                                        "temporarily unable",
                                        "Transport endpoint",
                                        "Slurm backup controller",
                                        "Job submit limit",
                                        "authentication credential",
                                        "Protocol authentication error",
                                        "Resource temporarily",
                                        "no answer within",
                                        "MUNGE",
                                        "Munge",
                                        "Message receive failure"};
  return std::any_of(kTexts.begin(), kTexts.end(), [&](std::string_view text) {
    return output.find(text) != std::string_view::npos;
  });
}

SlurmFate interpret_fate(const SlurmTask& task) {
  for (const auto& [state, fate] : kFates) {
    if (state != task.state) continue;
    // A node refused it, and Slurm does not try again by itself.
    const bool is_held = fate == SlurmFate::waiting &&
                         (task.reason.find("launch failed requeued held") != std::string::npos ||
                          task.reason.find("launch_failed_requeued_held") != std::string::npos);
    if (is_held) return SlurmFate::lost;
    // SIGTERM comes from others, and is no fault of the task's: a reboot, or a limit of the site.
    if (fate == SlurmFate::failed && task.status.signal == SIGTERM) return SlurmFate::lost;
    // A controller that has lost its state starts tasks again that run.
    if (fate == SlurmFate::failed && task.status.code == worker_not_begun) return SlurmFate::lost;
    return fate;
  }
  return SlurmFate::running;  // a state of a later version: the lease decides
}

bool is_requeued(const SlurmTask& task) {
  static constexpr std::array kStates = {"PENDING", "REQUEUED", "REQUEUE_FED", "CONFIGURING"};
  return std::find(kStates.begin(), kStates.end(), task.state) != kStates.end();
}

bool is_blameless(SlurmFate fate) {
  return fate == SlurmFate::preempted || fate == SlurmFate::lost;
}

TaskResult result_of_slurm(const SlurmTask& task, const std::optional<WorkerError>& error,
                           const std::filesystem::path& log) {
  const std::string place = task.node.empty() ? "" : " on node " + task.node;
  switch (interpret_fate(task)) {
    case SlurmFate::out_of_memory:
      return {Outcome::out_of_memory,
              0,
              fmt::format("out of memory{}: Slurm ended the worker (OUT_OF_MEMORY)", place),
              {}};
    case SlurmFate::timed_out:
      return {Outcome::timed_out,
              0,
              fmt::format("timed out{}: Slurm ended the worker at the end of its time ({})", place,
                          task.state),
              {}};
    case SlurmFate::preempted:
    case SlurmFate::lost:
      return {Outcome::environment_error,
              0,
              fmt::format("lost{} ({}, {})", place, task.state, task.reason),
              {}};
    case SlurmFate::cancelled:
      return {Outcome::environment_error,
              0,
              fmt::format("somebody cancelled the task in Slurm{}", place),
              {}};
    case SlurmFate::completed:
    case SlurmFate::failed:
    case SlurmFate::waiting:
    case SlurmFate::running:
      break;
  }
  return task_result({task.status, error, "", false}, log);
}

}  // namespace throng::jobs
