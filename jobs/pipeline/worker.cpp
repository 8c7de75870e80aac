#include "jobs/pipeline/worker.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <csignal>
#include <cstdlib>
#include <mutex>
#include <new>
#include <system_error>
#include <thread>

#include "base/error.h"
#include "base/files/staging.h"
#include "base/text/redact.h"
#include "jobs/pipeline/pipeline.h"
#include "jobs/queue/confine/credentials.h"
#include "jobs/queue/confine/file_fence.h"
#include "jobs/queue/workers/injected_faults.h"
#include "jobs/queue/workers/worker_interface.h"
#include "render/allocator.h"
#include "world/scenario.h"

namespace throng::jobs {

namespace {

// A worker without a supervisor would be a second writer beside the one that a restart begins.
void die_with_supervisor() {
  const char* supervisor = std::getenv(kSupervisorVariable);
  if (supervisor == nullptr) return;
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  // It may have died before the kernel knew that we care.
  if (std::to_string(::getppid()) != supervisor) std::_Exit(worker_environment_error);
}

// The way to the supervisor: takes stdout for itself, so that a driver that prints there cannot
// spoil a message.
class Reporter {
 public:
  explicit Reporter(std::vector<std::filesystem::path> folders)
      : folders_(std::move(folders)), output_(::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 0)) {
    ::dup2(STDERR_FILENO, STDOUT_FILENO);
  }
  ~Reporter() { ::close(output_); }
  Reporter(const Reporter&) = delete;
  Reporter& operator=(const Reporter&) = delete;

  void report(const TaskProgress& progress) {
    constexpr auto kInterval = std::chrono::milliseconds(100);
    const auto now = std::chrono::steady_clock::now();
    if (now - last_ < kInterval && progress.done < progress.total) return;
    last_ = now;
    write(progress_line(progress));
  }

  void give_sign_of_life() {
    write(sign_of_life_line());
    // Messages in a file shall arrive on other machines; a pipe refuses, and needs nothing.
    ::fdatasync(output_);
  }

  int fail(WorkerExit code, const char* kind, const std::string& what,
           std::vector<Problem> problems = {}) {
    for (Problem& problem : problems) problem.source = without_folders(problem.source, folders_);
    const std::string message = without_folders(what, folders_);
    write(error_line({kind, message, std::move(problems)}));
    spdlog::error("{}", message);
    return code;
  }

 private:
  void write(std::string line) {
    const std::lock_guard lock(mutex_);
    line += '\n';
    std::string_view rest = line;
    while (!rest.empty()) {
      const ssize_t count = ::write(output_, rest.data(), rest.size());
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) return;
      rest.remove_prefix(static_cast<std::size_t>(count));
    }
  }

  std::vector<std::filesystem::path> folders_;  ///< not to be named in messages
  int output_;
  std::chrono::steady_clock::time_point last_;
  std::mutex mutex_;  ///< of writing
};

// Tells the supervisor every few seconds that this process is there, whatever its task does.
class Heartbeat {
 public:
  explicit Heartbeat(Reporter& reporter)
      : thread_([&reporter](const std::stop_token& stop) {
          constexpr std::chrono::seconds kPause(5);
          std::mutex mutex;
          std::condition_variable_any ended;
          std::unique_lock lock(mutex);
          while (!ended.wait_for(lock, stop, kPause, [&] { return stop.stop_requested(); })) {
            reporter.give_sign_of_life();
            if (!is_staging_revoked()) continue;
            spdlog::error("the supervisor has taken this attempt back");
            std::_Exit(worker_environment_error);
          }
        }) {}

 private:
  std::jthread thread_;
};

// The log of a task is read through the service: times, what was begun, how it ended.
void log_to_stderr() {
  const auto logger = spdlog::stderr_logger_mt("worker");
  logger->set_pattern("%Y-%m-%dT%H:%M:%S.%eZ %l %v", spdlog::pattern_time_type::utc);
  spdlog::set_default_logger(logger);
}

int attempt_of_this_process() {
  const char* text = std::getenv(kAttemptVariable);
  return text == nullptr ? 1 : std::max(1, std::atoi(text));
}

/// Confines this process to the files of its job. Compiled shaders are kept between tasks: without
/// them each would begin with seconds of compiling.
std::string fence_worker(const std::filesystem::path& job_folder, const std::string& task_name) {
  FileFence fence = fence_of_folder(
      job_folder, task_name == kPublishName ? Credentials::readable : Credentials::hidden);
  const bool renders = task_name.find("/shard") != std::string::npos;
  if (const auto cache = shader_cache_folder(); renders && !cache.empty()) {
    std::error_code error;
    std::filesystem::create_directories(cache, error);
    fence.writable.push_back(cache);
  }
  return fence_this_process(fence);
}

void log_usage(const std::string& task, std::chrono::steady_clock::time_point begun) {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  constexpr long kKibPerMib = 1024;
  spdlog::info("{} done in {:.1f} s, {} MiB at most", task,
               std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count(),
               usage.ru_maxrss / kKibPerMib);
}

}  // namespace

int run_worker(const std::filesystem::path& job_folder, const std::string& task_name,
               const OtherTasks& others) {
  die_with_supervisor();
  log_to_stderr();
  if (task_name == kPublishName) take_credentials();
  const std::filesystem::path scenarios = world::scenarios_folder();
  // It opens no file of strangers: the dataset's are sent as they are.
  const Network network = task_name == kPublishName ? Network::allowed : Network::refused;
  for (const std::string& unlimited :
       {limit_this_process(network), fence_worker(job_folder, task_name)}) {
    if (!unlimited.empty()) spdlog::warn("the kernel lets nobody limit {}", unlimited);
  }
  render::tune_allocator();
  Reporter reporter({job_folder, scenarios});
  const auto lacks_memory = [&] {
    return reporter.fail(worker_out_of_memory, "environment",
                         "out of memory: what the worker may use does not suffice");
  };
  try {
    const Heartbeat heartbeat(reporter);
    const auto begun = std::chrono::steady_clock::now();
    const int attempt = attempt_of_this_process();
    spdlog::info("{} begun, attempt {}", task_name, attempt);
    inject_faults(task_name, attempt);
    const JobFolder folder(job_folder);
    const auto on_progress = [&](const TaskProgress& progress) { reporter.report(progress); };
    if (const auto other = others.find(task_name.substr(0, task_name.find('/')));
        other != others.end()) {
      other->second(folder, task_name, on_progress);
    } else {
      const ResolvedJob job = folder.read_job();
      do_task(folder, job, scenarios, task_named(job.spec(), task_name), on_progress);
    }
    log_usage(task_name, begun);
    return worker_succeeded;
  } catch (const InputError& error) {
    return reporter.fail(worker_input_error, "input", error.what(), error.problems());
  } catch (const EnvironmentError& error) {
    return reporter.fail(worker_environment_error, "environment", error.what());
  } catch (const std::system_error& error) {
    // A thread that finds no room for its stack.
    const bool is_lack = error.code() == std::errc::resource_unavailable_try_again ||
                         error.code() == std::errc::not_enough_memory;
    const bool is_limited =
        std::getenv(kMemoryVariable) != nullptr || std::getenv(kDataVariable) != nullptr;
    if (is_lack && is_limited) return lacks_memory();
    return reporter.fail(worker_environment_error, "environment", error.what());
  } catch (const std::bad_alloc&) {
    return lacks_memory();
  } catch (const std::exception& error) {
    return reporter.fail(worker_bug, "bug", error.what());
  }
}

}  // namespace throng::jobs
