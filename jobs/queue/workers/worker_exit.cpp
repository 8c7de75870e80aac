#include "jobs/queue/workers/worker_exit.h"

#include <fmt/core.h>

#include <algorithm>
#include <csignal>
#include <cstring>
#include <string>

#include "base/error.h"
#include "base/files/read_only_file.h"
#include "jobs/queue/workers/worker_protocol.h"

namespace throng::jobs {

namespace {

std::string read_tail(const std::filesystem::path& log) {
  constexpr std::int64_t kMaxTailBytes = 400;
  std::string text(kMaxTailBytes, '\0');
  try {
    const ReadOnlyFile file(log);
    text.resize(file.read_at(std::max<std::int64_t>(0, file.size() - kMaxTailBytes), text));
  } catch (const EnvironmentError&) {  // there is no log
    return "";
  }
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

Outcome classify_end(const EndedWorker& end) {
  if (!end.timeout.empty()) return Outcome::timed_out;
  if (end.status.signal == SIGKILL && end.memory_ran_out) return Outcome::out_of_memory;
  if (end.status.signal != 0) return Outcome::crashed;
  switch (end.status.code) {
    case worker_succeeded:
      return Outcome::succeeded;
    case worker_input_error:
      return Outcome::input_error;
    case worker_environment_error:
      return Outcome::environment_error;
    case worker_out_of_memory:
      return Outcome::out_of_memory;
    default:
      return Outcome::crashed;
  }
}

std::string describe_end(const EndedWorker& end, Outcome outcome) {
  if (outcome == Outcome::timed_out) return "timed out: " + end.timeout;
  if (end.error) return end.error->message;
  if (outcome == Outcome::out_of_memory) return "out of memory: the kernel killed the worker";
  if (end.status.signal == 0) {
    return fmt::format("the worker ended with exit code {}", end.status.code);
  }
  return fmt::format("the worker was killed by signal {} ({})", end.status.signal,
                     ::strsignal(end.status.signal));
}

}  // namespace

TaskResult task_result(const EndedWorker& end, const std::filesystem::path& log) {
  TaskResult result;
  result.outcome = classify_end(end);
  if (result.outcome == Outcome::succeeded) return result;
  result.message = describe_end(end, result.outcome);
  if (end.error) {
    result.problems = end.error->problems;
  } else if (const std::string tail = read_tail(log); !tail.empty()) {
    result.message += ":\n" + tail;
  }
  return result;
}

}  // namespace throng::jobs
