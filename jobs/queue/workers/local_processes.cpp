#include "jobs/queue/workers/local_processes.h"

#include <fmt/core.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <deque>
#include <memory>
#include <optional>
#include <thread>

#include "base/files/resources.h"
#include "base/resource_exhaustion.h"
#include "jobs/queue/confine/child_process.h"
#include "jobs/queue/confine/credentials.h"
#include "jobs/queue/confine/machine_memory.h"
#include "jobs/queue/confine/worker_limits.h"
#include "jobs/queue/workers/worker_exit.h"
#include "jobs/queue/workers/worker_messages.h"
#include "jobs/queue/workers/worker_protocol.h"

namespace throng::jobs {

namespace {

// How late the end of a silent worker, or a wish to stop, may be noticed.
constexpr int kPollMs = 50;

// The tasks of one call of run(), from the first worker's start to the last one's end.
class Batch {
 public:
  Batch(const LocalProcessesOptions& options, Admission& admission, const JobFolder& folder,
        std::span<const Task> tasks, const Executor::OnProgress& on_progress, std::stop_token stop,
        const Share& share)
      : options_(options),
        admission_(admission),
        share_(share),
        claimant_(admission, share.owner, share.job),
        folder_(folder),
        tasks_(tasks),
        on_progress_(on_progress),
        stop_(std::move(stop)),
        results_(tasks.size()) {
    for (std::size_t i = 0; i < tasks.size(); ++i) waiting_.push_back({i, options.now()});
  }

  std::vector<TaskResult> run() {
    while (true) {
      if (stop_.stop_requested()) end_others([](const Task&) { return true; });
      while (start_next()) {
      }
      say_why_nothing_runs();
      if (running_.empty() && waiting_.empty()) break;
      wait_for_news();
      for (auto& worker : running_) read_messages(*worker);
      collect_ended();
      for (auto& worker : running_) watch(*worker);
    }
    return std::move(results_);
  }

 private:
  struct Waiting {
    std::size_t task;
    SteadyTime from;  ///< not to be begun earlier
  };

  struct Worker {
    Worker(std::size_t index, Admission::Permit&& held, const std::vector<std::string>& command,
           const ChildProcess::Variables& variables, const std::filesystem::path& log,
           const SteadyNow& now)
        : task(index),
          permit(std::move(held)),
          begun(now()),
          heard(begun),
          process(command, variables, log) {}
    std::size_t task;
    Admission::Permit permit;  ///< given back when the process has ended
    SteadyTime begun;          ///< before its process, however long that takes to start
    SteadyTime heard;          ///< when it last said something
    ChildProcess process;
    long long kills_before = kills_for_memory();
    std::optional<WorkerError> error;
    std::string timeout;
    std::optional<SteadyTime> kill_at;  ///< it was asked to end: its result is of no use
  };

  // Begins the next task that need not rest; false when there is none, or others are ahead.
  bool start_next() {
    const SteadyTime now = options_.now();
    const auto next = std::find_if(waiting_.begin(), waiting_.end(),
                                   [&](const Waiting& waiting) { return waiting.from <= now; });
    if (next == waiting_.end()) {
      claimant_.withdraw();
      return false;
    }
    const std::size_t task = next->task;
    const std::int64_t memory_mib = share_.memory_mib(tasks_[task]);
    auto permit = claimant_.request(
        share_.priority(), waiting_.size() + running_.size() + share_.later_tasks, memory_mib);
    if (!permit) return false;
    waiting_.erase(next);
    const int attempt = ++results_[task].attempts;
    std::vector<std::string> command = options_.command;
    command.insert(command.end(),
                   {"--job", folder_.path().string(), "--task", to_string(tasks_[task])});
    try {
      running_.push_back(std::make_unique<Worker>(task, std::move(*permit), command,
                                                  task_variables(tasks_[task], attempt, memory_mib),
                                                  folder_.log_file(tasks_[task]), options_.now));
      exhausted_.clear();
    } catch (const ResourcesExhausted& error) {
      // Nothing that the job could have caused: it waits for as long as it takes.
      --results_[task].attempts;
      waiting_.push_back({task, after(options_.rest_s)});
      exhausted_ = error.what();
    } catch (const EnvironmentError& error) {
      fail(task, {Outcome::environment_error, 0, error.what(), {}});
    }
    return true;
  }

  void say_why_nothing_runs() {
    std::string reason;
    if (running_.empty() && !waiting_.empty()) {
      reason = claimant_.waits_for_memory() ? "there is not enough free memory" : exhausted_;
    }
    if (reason == reason_) return;
    reason_ = reason;
    share_.on_wait(reason);
  }

  ChildProcess::Variables task_variables(const Task& task, int attempt,
                                         std::int64_t memory_mib) const {
    ChildProcess::Variables variables = {{kSupervisorVariable, std::to_string(::getpid())},
                                         {kAttemptVariable, std::to_string(attempt)}};
    if (task.kind == Task::Kind::publish) {
      const ChildProcess::Variables credentials = credential_variables();
      variables.insert(variables.end(), credentials.begin(), credentials.end());
    }
    if (options_.worker_memory_mib > 0) {
      variables.emplace_back(kMemoryVariable, std::to_string(options_.worker_memory_mib));
    } else if (options_.limits_by_need && memory_mib > 0) {
      constexpr std::int64_t kMoreMib = 2048;
      variables.emplace_back(kDataVariable, std::to_string(2 * memory_mib + kMoreMib));
    }
    // One core per worker: Mesa's software renderer would start a thread per core in each.
    if (options_.workers > 1 && (tasks_.size() > 1 || admission_.jobs() > 1))
      variables.emplace_back("LP_NUM_THREADS", "0");
    return variables;
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
      worker.heard = options_.now();
      const WorkerMessage message = read_worker_message(line);
      if (message.error) worker.error = message.error;
      if (message.progress && on_progress_) on_progress_(tasks_[worker.task], *message.progress);
    }
  }

  // Kills what hangs, takes too long, or does not end when asked to.
  void watch(Worker& worker) const {
    const SteadyTime now = options_.now();
    const auto since = [&](SteadyTime then) {
      return std::chrono::duration<double>(now - then).count();
    };
    if (worker.kill_at) {
      if (steady_now() >= *worker.kill_at) worker.process.signal_group(SIGKILL);
      return;
    }
    if (since(worker.heard) > options_.lease_s) {
      worker.timeout = fmt::format("no sign of life for {} s", options_.lease_s);
    } else if (options_.max_task_s > 0 && since(worker.begun) > options_.max_task_s) {
      worker.timeout = fmt::format("the task took longer than {} s", options_.max_task_s);
    }
    if (!worker.timeout.empty()) worker.process.signal_group(SIGKILL);
  }

  void collect_ended() {
    std::vector<std::unique_ptr<Worker>> ended;
    for (auto worker = running_.begin(); worker != running_.end();) {
      if (!(*worker)->process.has_ended()) {
        ++worker;
        continue;
      }
      ended.push_back(std::move(*worker));
      worker = running_.erase(worker);
    }
    for (const auto& worker : ended) {
      read_messages(*worker);
      const ExitStatus status = worker->process.wait();
      const bool memory_ran_out = kills_for_memory() > worker->kills_before;
      TaskResult result = task_result({status, worker->error, worker->timeout, memory_ran_out},
                                      folder_.log_file(tasks_[worker->task]));
      const bool is_cancelled = result.outcome != Outcome::succeeded && worker->kill_at;
      if (options_.meters != nullptr) {
        const std::chrono::duration<double> took = options_.now() - worker->begun;
        options_.meters->note(tasks_[worker->task],
                              to_string(is_cancelled ? Outcome::cancelled : result.outcome),
                              took.count());
      }
      if (result.outcome == Outcome::succeeded) {
        results_[worker->task].cpu_s = status.cpu_s;
        continue;
      }
      if (is_cancelled) {
        results_[worker->task].outcome = Outcome::cancelled;
      } else {
        fail(worker->task, std::move(result));
      }
    }
  }

  // Lets the task rest and tries it again, or gives it up, and with it the tasks of its run. A job
  // that is wrong is given up as a whole.
  void fail(std::size_t task, TaskResult result) {
    const int attempts = results_[task].attempts;
    const bool is_wrong = result.outcome == Outcome::input_error;
    if (!is_wrong && attempts < options_.attempts) {
      constexpr double kLonger = 4;
      waiting_.push_back({task, after(options_.rest_s * std::pow(kLonger, attempts - 1))});
      return;
    }
    result.attempts = attempts;
    results_[task] = std::move(result);
    const int run = tasks_[task].run;
    end_others([&](const Task& other) { return is_wrong || other.run == run; });
  }

  template <typename Condition>
  void end_others(const Condition& condition) {
    const auto gone = std::remove_if(waiting_.begin(), waiting_.end(), [&](const Waiting& waiting) {
      if (!condition(tasks_[waiting.task])) return false;
      results_[waiting.task].outcome = Outcome::cancelled;
      return true;
    });
    waiting_.erase(gone, waiting_.end());
    for (auto& worker : running_) {
      if (worker->kill_at || !condition(tasks_[worker->task])) continue;
      worker->kill_at = steady_now() + steady_seconds(options_.grace_s);
      worker->process.signal_group(SIGTERM);
    }
  }

  SteadyTime after(double seconds) const { return options_.now() + steady_seconds(seconds); }

  const LocalProcessesOptions& options_;
  Admission& admission_;
  const Share& share_;
  Admission::Claimant claimant_;
  std::string
      exhausted_;       ///< why no worker could be started when that was last tried; "" if one was
  std::string reason_;  ///< that was last given to share_.on_wait
  const JobFolder& folder_;
  std::span<const Task> tasks_;
  const Executor::OnProgress& on_progress_;
  std::stop_token stop_;
  std::deque<Waiting> waiting_;
  std::vector<std::unique_ptr<Worker>> running_;
  std::vector<TaskResult> results_;
};

}  // namespace

LocalProcesses::LocalProcesses(LocalProcessesOptions options) : options_(std::move(options)) {
  if (options_.command.empty()) options_.command = {program_path().string(), "worker"};
  if (options_.workers == 0) {
    options_.workers = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  }
  AdmissionLimits limits{
      .workers = options_.workers, .memory_mib = options_.memory_mib, .now = options_.now};
  if (options_.waits_for_memory) limits.available_mib = &available_memory_mib;
  admission_ = std::make_unique<Admission>(std::move(limits));
}

std::vector<TaskResult> LocalProcesses::run(const JobFolder& folder, std::span<const Task> tasks,
                                            const OnProgress& on_progress, std::stop_token stop,
                                            const Share& share) {
  return Batch(options_, *admission_, folder, tasks, on_progress, std::move(stop), share).run();
}

}  // namespace throng::jobs
