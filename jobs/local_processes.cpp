#include "jobs/local_processes.h"

#include <fmt/core.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstring>
#include <deque>
#include <fstream>
#include <memory>
#include <optional>
#include <thread>

#include "base/resources.h"
#include "jobs/child_process.h"
#include "jobs/worker.h"
#include "jobs/worker_messages.h"

namespace throng::jobs {

namespace {

using Clock = std::chrono::steady_clock;

// How late the end of a silent worker, or a wish to stop, may be noticed.
constexpr int kPollMs = 50;

// The last lines of a log, to say why a worker died without a word.
std::string tail_of(const std::filesystem::path& log) {
  constexpr std::streamoff kLongest = 400;
  std::ifstream file(log, std::ios::binary | std::ios::ate);
  const std::streamoff size = file ? static_cast<std::streamoff>(file.tellg()) : 0;
  if (size <= 0) return "";
  file.seekg(std::max<std::streamoff>(0, size - kLongest));
  std::string text(std::istreambuf_iterator<char>(file), {});
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

// The tasks of one call of run(), from the first worker's start to the last one's end.
class Batch {
 public:
  Batch(const LocalProcessesOptions& options, const JobFolder& folder, std::span<const Task> tasks,
        const Executor::OnProgress& on_progress, std::stop_token stop)
      : options_(options),
        folder_(folder),
        tasks_(tasks),
        on_progress_(on_progress),
        stop_(std::move(stop)),
        slots_(std::min(static_cast<std::size_t>(options.workers), tasks.size())),
        results_(tasks.size()) {
    for (std::size_t i = 0; i < tasks.size(); ++i) waiting_.push_back(i);
  }

  std::vector<TaskResult> run() {
    while (true) {
      if (stop_.stop_requested()) end_all();
      while (!waiting_.empty() && running_.size() < slots_) start_next();
      if (running_.empty()) break;
      wait_for_news();
      for (auto& worker : running_) read_messages(*worker);
      collect_ended();
      if (ending_ && Clock::now() >= deadline_) {
        for (auto& worker : running_) worker->process.signal_group(SIGKILL);
      }
    }
    return std::move(results_);
  }

 private:
  struct Worker {
    Worker(std::size_t index, const std::vector<std::string>& command,
           const ChildProcess::Variables& variables, const std::filesystem::path& log)
        : task(index), process(command, variables, log) {}
    std::size_t task;
    ChildProcess process;
    std::optional<WorkerError> error;
  };

  void start_next() {
    const std::size_t task = waiting_.front();
    waiting_.pop_front();
    ++results_[task].attempts;
    std::vector<std::string> command = options_.command;
    command.insert(command.end(),
                   {"--job", folder_.path().string(), "--task", name_of(tasks_[task])});
    ChildProcess::Variables variables = {{kSupervisorVariable, std::to_string(::getpid())}};
    // One core per worker: Mesa's software renderer would start a thread per core in each.
    if (slots_ > 1) variables.emplace_back("LP_NUM_THREADS", "0");
    try {
      running_.push_back(
          std::make_unique<Worker>(task, command, variables, folder_.log_of(tasks_[task])));
    } catch (const EnvironmentError& error) {
      fail(task, {Outcome::environment_error, 0, error.what(), {}});
    }
  }

  void wait_for_news() {
    std::vector<pollfd> outputs;
    for (const auto& worker : running_) outputs.push_back({worker->process.output(), POLLIN, 0});
    ::poll(outputs.data(), outputs.size(), kPollMs);
    // A closed pipe is always "readable": give its process the moment it needs to end.
    for (const pollfd& output : outputs) {
      if ((output.revents & (POLLIN | POLLHUP)) == POLLHUP) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
    }
  }

  void read_messages(Worker& worker) {
    for (const std::string& line : worker.process.read_lines()) {
      const WorkerMessage message = read_worker_message(line);
      if (message.error) worker.error = message.error;
      if (message.progress && on_progress_) on_progress_(tasks_[worker.task], *message.progress);
    }
  }

  void collect_ended() {
    for (auto worker = running_.begin(); worker != running_.end();) {
      if (!(*worker)->process.has_ended()) {
        ++worker;
        continue;
      }
      read_messages(**worker);
      const std::size_t task = (*worker)->task;
      TaskResult result = result_of(**worker);
      worker = running_.erase(worker);
      if (result.outcome == Outcome::succeeded) continue;
      if (ending_) {
        results_[task].outcome = Outcome::cancelled;
      } else {
        fail(task, std::move(result));
      }
    }
  }

  TaskResult result_of(Worker& worker) const {
    const ExitStatus status = worker.process.wait();
    TaskResult result;
    if (worker.error) {
      result.message = worker.error->message;
      result.problems = worker.error->problems;
    }
    if (status.signal == 0 && status.code == worker_succeeded) return result;
    if (status.signal == 0 && status.code == worker_input_error) {
      result.outcome = Outcome::input_error;
    } else if (status.signal == 0 && status.code == worker_environment_error) {
      result.outcome = Outcome::environment_error;
    } else {
      result.outcome = Outcome::crashed;
    }
    if (result.message.empty()) {
      const char* hint = status.signal == SIGKILL ? "; perhaps it ran out of memory" : "";
      result.message = status.signal != 0
                           ? fmt::format("the worker was killed by signal {} ({}){}", status.signal,
                                         ::strsignal(status.signal), hint)
                           : fmt::format("the worker ended with exit code {}", status.code);
      const std::string log = tail_of(folder_.log_of(tasks_[worker.task]));
      if (!log.empty()) result.message += ":\n" + log;
    }
    return result;
  }

  // Tries the task again or lets it, and with it all others, end.
  void fail(std::size_t task, TaskResult result) {
    result.attempts = results_[task].attempts;
    if (result.outcome != Outcome::input_error && result.attempts < options_.attempts) {
      waiting_.push_back(task);
      return;
    }
    results_[task] = std::move(result);
    end_all();
  }

  void end_all() {
    if (ending_) return;
    ending_ = true;
    deadline_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                   std::chrono::duration<double>(options_.grace_s));
    for (const std::size_t task : waiting_) results_[task].outcome = Outcome::cancelled;
    waiting_.clear();
    for (auto& worker : running_) worker->process.signal_group(SIGTERM);
  }

  const LocalProcessesOptions& options_;
  const JobFolder& folder_;
  std::span<const Task> tasks_;
  const Executor::OnProgress& on_progress_;
  std::stop_token stop_;
  std::size_t slots_;
  std::deque<std::size_t> waiting_;
  std::vector<std::unique_ptr<Worker>> running_;
  std::vector<TaskResult> results_;
  bool ending_ = false;
  Clock::time_point deadline_;
};

}  // namespace

LocalProcesses::LocalProcesses(LocalProcessesOptions options) : options_(std::move(options)) {
  if (options_.command.empty()) options_.command = {program_path().string(), "worker"};
  if (options_.workers == 0) {
    options_.workers = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  }
}

std::vector<TaskResult> LocalProcesses::run(const JobFolder& folder, std::span<const Task> tasks,
                                            const OnProgress& on_progress, std::stop_token stop) {
  return Batch(options_, folder, tasks, on_progress, std::move(stop)).run();
}

}  // namespace throng::jobs
