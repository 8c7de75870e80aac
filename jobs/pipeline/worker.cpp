#include "jobs/pipeline/worker.h"

#include <spdlog/spdlog.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <mutex>
#include <string>
#include <thread>

#include "base/files/staging.h"
#include "jobs/pipeline/pipeline.h"
#include "jobs/queue/workers/injected_faults.h"
#include "jobs/queue/workers/worker_interface.h"
#include "jobs/queue/workers/worker_process.h"
#include "render/allocator.h"
#include "world/scenario.h"

namespace throng::jobs {

namespace {

using Clock = std::chrono::steady_clock;

// Tells the supervisor every few seconds that this process is there, whatever its task does.
class Heartbeat {
 public:
  explicit Heartbeat(WorkerProcess& process)
      : thread_([&process](const std::stop_token& stop) {
          constexpr std::chrono::seconds kPause(5);
          std::mutex mutex;
          std::condition_variable_any ended;
          std::unique_lock lock(mutex);
          while (!ended.wait_for(lock, stop, kPause, [&] { return stop.stop_requested(); })) {
            process.send(sign_of_life_line() + "\n");
            process.sync();
            if (!is_staging_revoked()) continue;
            spdlog::error("the supervisor has taken this attempt back");
            std::_Exit(worker_environment_error);
          }
        }) {}

 private:
  std::jthread thread_;
};

int attempt_of_this_process() {
  const char* text = std::getenv(kAttemptVariable);
  return text == nullptr ? 1 : std::max(1, std::atoi(text));
}

/// Sends lines of progress, unless the last one has been sent only just before.
class ProgressLines {
 public:
  explicit ProgressLines(WorkerProcess& process) : process_(process) {}

  void add(const TaskProgress& progress) {
    constexpr auto kInterval = std::chrono::milliseconds(100);
    const auto now = Clock::now();
    if (now - last_ < kInterval && progress.done < progress.total) return;
    last_ = now;
    process_.send(progress_line(progress) + "\n");
  }

 private:
  WorkerProcess& process_;
  Clock::time_point last_;
};

void log_usage(const std::string& task, Clock::time_point begun) {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  constexpr long kKibPerMib = 1024;
  spdlog::info("{} done in {:.1f} s, {} MiB at most", task,
               std::chrono::duration<double>(Clock::now() - begun).count(),
               usage.ru_maxrss / kKibPerMib);
}

}  // namespace

int run_worker(const std::filesystem::path& job_folder, const std::string& task_name,
               const OtherTasks& others) {
  const std::filesystem::path scenarios = world::scenarios_folder();
  WorkerProcess process({.folder = job_folder,
                         .unnamed = {scenarios},
                         .keeps_shaders = task_name.find("/shard") != std::string::npos,
                         .publishes = task_name == kPublishName});
  render::tune_allocator();
  const auto work = [&] {
    const Heartbeat heartbeat(process);
    const auto begun = Clock::now();
    const int attempt = attempt_of_this_process();
    spdlog::info("{} begun, attempt {}", task_name, attempt);
    inject_faults(task_name, attempt);
    const JobFolder folder(job_folder);
    ProgressLines lines(process);
    const auto on_progress = [&](const TaskProgress& progress) { lines.add(progress); };
    if (const auto other = others.find(task_name.substr(0, task_name.find('/')));
        other != others.end()) {
      other->second(folder, task_name, on_progress);
    } else {
      const ResolvedJob job = folder.read_job();
      do_task(folder, job, scenarios, task_named(job.spec(), task_name), on_progress);
    }
    log_usage(task_name, begun);
  };
  return process.run(work, [](const WorkerError& error) { return error_line(error) + "\n"; });
}

}  // namespace throng::jobs
